// Runs the built program as a user would.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace porosph {

struct Outcome {
  int status = -1;
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A folder of its own, removed in the end, in which the program runs.
class Workplace {
 public:
  Workplace() {
    std::string name = (std::filesystem::temp_directory_path() / "porosph_app_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
  }
  ~Workplace() { std::filesystem::remove_all(folder_); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  Outcome porosph(const std::string& arguments) const {
    const int status = shell("'" POROSPH_PROGRAM "' " + arguments);
    return {status, text_of(folder_ / "out"), text_of(folder_ / "err")};
  }

  /// Exit status of a shell's commands, which write into the files `out` and `err`.
  int shell(const std::string& commands) const {
    const std::string command = "cd '" + folder_.string() + "' && { " + commands + "; } >out 2>err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }

 private:
  std::filesystem::path folder_;
};

/// A submerged column of 4 x 8 particles that is computed in a moment.
inline const char* const small_case = R"(title = "Small <column> & \"water\""
reference = "column"
[particles]
spacing = 0.5
arrangement = "lattice"
[[soil]]
name = "sand"
polygon = [[0, 0], [2, 0], [2, 4], [0, 4]]
youngs_modulus = 15e6
poissons_ratio = 0.33
unit_weight_saturated = 20e3
[water]
level = 5
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 5]
[[boundary]]
kind = "roller"
from = [2, 0]
to = [2, 5]
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [2, 0]
[loading]
damping = 0.05
[time]
end = 1
courant = 0.4
[output]
interval = 0.1
[[probe]]
name = "A"
position = [1, 2]
)";

}  // namespace porosph
