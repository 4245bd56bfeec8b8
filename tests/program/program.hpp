// SPDX-License-Identifier: MIT
#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <support/temporary_directory.hpp>

namespace glint::testing {

/// What a run of the glint program left behind.
struct Outcome {
  int status = 0;  ///< of its exit; 128 + the signal that ended it
  std::string out;
  std::string err;
};

/// A run of the glint program in a directory, its streams in files.
class Program {
 public:
  Program(const std::filesystem::path& directory, const std::vector<std::string>& arguments) {
    std::vector<char*> argv{const_cast<char*>(GLINT_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("fork failed");
    if (process_ == 0) run(directory, argv.data());
  }

  /// Ctrl-C.
  void interrupt() const { kill(process_, SIGINT); }

  [[nodiscard]] Outcome wait() const {
    int status = 0;
    waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content_of(streams_ / "out"),
            content_of(streams_ / "err")};
  }

 private:
  /// In the child: nothing here may return.
  [[noreturn]] void run(const std::filesystem::path& directory, char** argv) const {
    redirect(STDIN_FILENO, "/dev/null");
    redirect(STDOUT_FILENO, streams_ / "out");
    redirect(STDERR_FILENO, streams_ / "err");
    if (chdir(directory.c_str()) == 0) execv(GLINT_PROGRAM, argv);
    _exit(127);
  }
  static void redirect(int stream, const std::filesystem::path& path) {
    const int file = open(path.c_str(), stream == STDIN_FILENO ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, stream) < 0) _exit(126);
    close(file);
  }

  TemporaryDirectory streams_;
  pid_t process_ = 0;
};

[[nodiscard]] inline Outcome glint_program(const std::filesystem::path& directory,
                                           const std::vector<std::string>& arguments) {
  return Program(directory, arguments).wait();
}

/// One sentence of the program's, on a line of its own.
[[nodiscard]] inline bool is_one_sentence(const std::string& text) {
  return text.starts_with("glint: ") && text.find('\n') == text.size() - 1;
}

/// The names of all files and directories below.
[[nodiscard]] inline std::set<std::string> entries_below(const std::filesystem::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    names.insert(entry.path().lexically_relative(directory).string());
  }
  return names;
}

/// A floor (`floor.obj`) and a sphere on it under a point light: `scene.json`, 24 × 16 pixels at 4 samples.
inline void write_scene(const TemporaryDirectory& directory) {
  directory.write("floor.obj", "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\nf 1 2 3 4\n");
  directory.write("scene.json", R"({
    "integrator": {"type": "intersection_test", "point_light_position": [2, 4, 2], "point_light_flux": [300, 250, 200],
                   "spp": 4},
    "film": {"resolution": [24, 16]},
    "camera": {"position": [0, 1.5, 6], "look_at": [0, 0.8, 0], "fov": 40},
    "textures": {"grey": {"type": "constant", "color": [0.6, 0.5, 0.4]}},
    "materials": {"matte": {"type": "diffuse", "texture_name": "grey"}},
    "objects": [{"type": "mesh", "path": "floor.obj", "material_name": "matte"},
                {"type": "sphere", "center": [0, 1, 0], "material_name": "matte"}]})");
}

}  // namespace glint::testing
