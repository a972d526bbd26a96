#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/import/drawing.hpp"

extern char** environ;

namespace porosph::drawn {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name that holds this text, to be read from its beginning.
File file_of(const std::string& text) {
  File file(std::tmpfile(), &std::fclose);
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0)
    throw DrawingError("no temporary file to hand over the lines by");
  std::rewind(file.get());
  return file;
}

/// What a program prints that is given this input. Throws DrawingError where it cannot be started.
std::string output_of(const fs::path& program, const std::string& argument, const std::string& input) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw DrawingError("no pipe to read the drawing by");
  const File given_to = file_of(input);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(given_to.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  std::string name = program.string(), given = argument;
  std::array<char*, 3> arguments = {name.data(), given.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawn(&child, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  std::array<char, 65536> buffer{};
  for (ssize_t n = 0; failure == 0 && (n = read(ends[0], buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  if (failure != 0) throw DrawingError(fmt::format("{} cannot be started", name));
  int status = 0;
  waitpid(child, &status, 0);
  return text;
}

/// The same as JSON. Throws DrawingError also where the program gave up.
Json answer_of(const fs::path& program, const std::string& argument, const std::string& input) {
  Json answer = Json::parse(output_of(program, argument, input), nullptr, false);
  if (answer.is_discarded()) throw DrawingError("GDAL gave up reading it");
  if (answer.contains("error"))
    throw DrawingError(fmt::format("cannot be read: {}", answer["error"].get<std::string>()));
  return answer;
}

Polygon ring_of(const Json& points) {
  Polygon ring;
  for (const Json& p : points) ring.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  return ring;
}

ShapeKind kind_of(const std::string& name) {
  static const std::map<std::string, ShapeKind> kinds = {{"area", ShapeKind::area},
                                                         {"line", ShapeKind::line},
                                                         {"rows", ShapeKind::rows},
                                                         {"point", ShapeKind::point}};
  return kinds.at(name);
}

Drawing drawing_of(const Json& answer) {
  Drawing drawing;
  drawing.unit = answer.at("unit");
  drawing.left_out = answer.at("left_out").get<std::vector<std::string>>();
  for (const Json& shape : answer.at("shapes")) {
    drawing.shapes.push_back({shape.at("layer"), shape.at("text"), kind_of(shape.at("kind")), {}});
    for (const Json& ring : shape.at("rings")) drawing.shapes.back().rings.push_back(ring_of(ring));
  }
  return drawing;
}

}  // namespace

Drawing read_drawing(const fs::path& file, const fs::path& reader) {
  if (!fs::is_regular_file(file))
    throw DrawingError(fmt::format("{}: is not a readable file", file.string()));
  if (!fs::exists(reader))
    throw DrawingError(
        fmt::format("{}: drawings cannot be read here: this program was built without GDAL (Debian: install "
                    "libgdal-dev and build it again, or install the package porosph-drawings)",
                    file.string()));
  try {
    return drawing_of(answer_of(reader, fs::absolute(file).string(), ""));
  } catch (const Json::exception&) {
    throw DrawingError(fmt::format("{}: holds coordinates that are not finite numbers", file.string()));
  } catch (const DrawingError& error) {
    throw DrawingError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Regions regions_between(const std::vector<Polygon>& lines, const fs::path& reader) {
  Json asked = {{"lines", Json::array()}};
  for (const Polygon& line : lines) {
    Json points = Json::array();
    for (const Point& p : line) points.push_back({p.x(), p.y()});
    asked["lines"].push_back(std::move(points));
  }
  const Json answer = answer_of(reader, "--regions", asked.dump());
  Regions found;
  for (const Json& region : answer.at("regions")) {
    found.rings.emplace_back();
    for (const Json& ring : region) {
      found.rings.back().push_back(ring_of(ring));
      found.rings.back().back().pop_back();  // the first point again
    }
  }
  for (const Json& gap : answer.at("gaps"))
    found.gaps.push_back({ring_of(Json::array({gap.at("at")})).front(), gap.at("gap").get<double>()});
  return found;
}

}  // namespace porosph::drawn
