// Requests from outside to end a long computation.
#pragma once

namespace porosph::app {

/// From now on Ctrl-C, SIGTERM and a terminal that closes (SIGHUP, unless nohup had it ignored) ask the
/// program to end in order, and a second Ctrl-C or SIGTERM ends it at once. Writing to a pipe that nobody
/// reads any more is an error of that write, not the end of the program.
void catch_interruptions();

bool is_interrupted();

}  // namespace porosph::app
