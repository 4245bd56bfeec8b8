// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include <glint/io/image.hpp>

#include <support/catch.hpp>

#include "program.hpp"

namespace {

using glint::testing::content_of;
using glint::testing::entries_below;
using glint::testing::glint_program;
using glint::testing::is_one_sentence;
using glint::testing::Outcome;
using glint::testing::TemporaryDirectory;
using glint::testing::write_scene;
using Arguments = std::vector<std::string>;

/// The scene, and files of which each is wrong in a way of its own.
struct Junkyard {
  TemporaryDirectory directory;

  Junkyard() {
    write_scene(directory);
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    directory.write("bad_index.obj", triangle + "f 1 2 3\nf 1 2 9\n");
    directory.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    directory.write("infinite.obj", "v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n");
    directory.write("empty.obj", "");
    directory.write("no_faces.obj", triangle);
    directory.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    directory.write("mesh.ply", "ply\nformat ascii 1.0\nend_header\n");
    directory.write("not.json", "{\"integrator\": {\n");
    directory.write("empty.json", "");
    const glint::Image image({64, 64}, 0.5F);
    write_exr(image, directory / "whole.exr");
    write_png(image, directory / "whole.png");
    for (const char* const extension : {".exr", ".png"}) {
      const std::string whole = content_of(directory / (std::string("whole") + extension));
      directory.write(std::string("cut") + extension, whole.substr(0, whole.size() / 2));
      directory.write(std::string("stub") + extension, whole.substr(0, 10));
      directory.write(std::string("void") + extension, "");
    }
    std::filesystem::create_directory(directory / "folder.exr");
  }

  /// Exit status 1 or 2, one sentence that tells of `about`, and nothing written.
  void check_fails(const Arguments& arguments, const std::string& about) const {
    const auto before = entries_below(directory.path());
    const Outcome outcome = glint_program(directory.path(), arguments);
    CAPTURE(arguments, outcome.err);
    CHECK((outcome.status == 1 || outcome.status == 2));
    CHECK(is_one_sentence(outcome.err));
    CHECK(outcome.err.find(about) != std::string::npos);
    CHECK(outcome.out.empty());
    CHECK(entries_below(directory.path()) == before);
  }
  void check_fails_with(const std::string& json, const std::string& about) const {
    check_fails({"render", "scene.json", "--override", json}, about);
  }
  void check_mesh_fails(const std::string& name, const std::string& about) const {
    check_fails_with(R"({"objects": [{"type": "mesh", "material_name": "matte", "path": ")" + name + "\"}]}",
                     "scene.json:/objects/0/path: " + name + about);
    check_fails({"info", name}, name + about);
  }
};

}  // namespace

TEST_CASE("program: wrong usage is one sentence, with status 2", "[program]") {
  const Junkyard junk;
  const std::vector<std::pair<Arguments, std::string>> cases{
      {{}, "subcommand"},
      {{"paint"}, "\"paint\" is not a subcommand"},
      {{"--frob"}, "subcommand"},
      {{"render"}, "SCENE"},
      {{"info"}, "FILE"},
      {{"render", "scene.json", "--frob"}, "--frob"},
      {{"render", "scene.json", "other.json"}, "other.json"},
      {{"render", "scene.json", "--spp"}, "--spp"},
      {{"render", "scene.json", "--spp", "-4"}, "--spp"},
      {{"render", "scene.json", "--spp", "0"}, "--spp"},
      {{"render", "scene.json", "--spp", "many"}, "--spp"},
      {{"render", "scene.json", "--spp", "99999999999999999999"}, "--spp"},
      {{"render", "scene.json", "--seed", "-1"}, "--seed"},
      {{"render", "scene.json", "--threads", "0"}, "--threads"},
      {{"render", "scene.json", "--tile-size", "0"}, "--tile-size"},
      {{"render", "scene.json", "--resolution", "10"}, "--resolution"},
      {{"render", "scene.json", "--resolution", "0x10"}, "--resolution"},
      {{"render", "scene.json", "--resolution", "10x10x10"}, "--resolution"},
      {{"render", "scene.json", "--resolution", "65536x65536"}, "--resolution"},
      {{"render", "scene.json", "--exposure", "nan"}, "--exposure"},
      {{"render", "scene.json", "--exposure", "1000"}, "--exposure"}};
  for (const auto& [arguments, about] : cases) {
    junk.check_fails(arguments, about);
    CHECK(glint_program(junk.directory.path(), arguments).status == 2);
  }
}

TEST_CASE("program: a scene that is not there, or is none, is one sentence", "[program]") {
  const Junkyard junk;
  junk.check_fails({"render", "no.json"}, "no.json: cannot be read: No such file or directory");
  junk.check_fails({"render", "."}, ".: is a directory, expected a file");
  junk.check_fails({"render", "not.json"}, "not.json:2: is not JSON");
  junk.check_fails({"render", "empty.json"}, "empty.json:1: is not JSON");
  junk.check_fails({"render", "whole.exr"}, "whole.exr:1: is not JSON");
  junk.check_fails({"info", "not.json"}, "not.json:2: is not JSON");
}

TEST_CASE("program: what is wrong in a scene is one sentence with its place", "[program]") {
  const Junkyard junk;
  junk.check_fails_with(R"({"integrator": {"spp": -1}})", "/integrator/spp: found -1, expected an integer");
  junk.check_fails_with(R"({"integrator": {"type": "mlt"}})", "/integrator/type: found \"mlt\", expected one of");
  junk.check_fails_with(R"({"film": {"resolution": [1000000, 1000000]}})", "/film/resolution/0: found 1000000");
  junk.check_fails_with(R"({"camera": {"fov": "wide"}})", "/camera/fov: found \"wide\", expected");
  junk.check_fails_with(R"({"materials": {"matte": {"type": "velvet"}}})", "/materials/matte/type: found \"velvet\"");
  junk.check_fails_with(R"({"materials": {"matte": {"texture_name": "gray"}}})", "did you mean \"grey\"?");
  junk.check_fails_with(R"({"objects": [{"type": "sphere", "material_name": "mat"}]})", "no material named \"mat\"");
  junk.check_fails_with(R"({"objects": [{"type": "cube", "material_name": "matte"}]})",
                        "/objects/0/type: found \"cube\"");
  junk.check_fails_with(R"({"objects": [{"type": "instance"}]})", "/objects/0/type: found \"instance\"");
  junk.check_fails_with(R"({"environment_map": {"texture_name": "sky"}})", "no texture named \"sky\"");
  junk.check_fails_with("{", "--override:1: is not JSON");
  junk.check_fails_with("7", "--override: found 7, expected an object");
  junk.check_fails({"render", "scene.json", "--integrator", "mlt"}, "--integrator: found \"mlt\", expected one of");
}

TEST_CASE("program: what is wrong in a mesh is one sentence with its place", "[program]") {
  const Junkyard junk;
  junk.check_mesh_fails("bad_index.obj", ":5: face refers to vertex 9, but the file has 3 vertices");
  junk.check_mesh_fails("nan.obj", ":2: vertex has nan, expected a finite number");
  junk.check_mesh_fails("infinite.obj", ":2: vertex has 1e99, expected a finite number");
  junk.check_mesh_fails("empty.obj", ": has no faces, expected a mesh");
  junk.check_mesh_fails("no_faces.obj", ": has no faces, expected a mesh");
  junk.check_mesh_fails("missing.obj", ": cannot be read: No such file or directory");
  junk.check_mesh_fails("mesh.ply", ": ");
  junk.check_fails_with(R"({"objects": [{"type": "mesh", "path": "flat.obj", "light": {}}]})",
                        "/objects/0: a mesh without area cannot be a light");
}

TEST_CASE("program: a damaged or missing texture is one sentence with its place", "[program]") {
  const Junkyard junk;
  for (const char* const name : {"cut.exr", "stub.exr", "void.exr", "cut.png", "stub.png", "void.png", "missing.exr",
                                 "missing.jpg", "floor.obj", "folder.exr"}) {
    junk.check_fails_with(R"({"textures": {"grey": {"type": "image", "path": ")" + std::string(name) + "\"}}}",
                          std::string("scene.json:/textures/grey/path: ") + name + ": ");
  }
  for (const char* const name : {"cut.exr", "stub.exr", "void.exr", "cut.png", "stub.png", "void.png"}) {
    junk.check_fails({"info", name}, std::string(name) + ": ");
    junk.check_fails({"compare", name, "whole.exr"}, std::string(name) + ": ");
  }
}

TEST_CASE("program: an output that cannot be written is one sentence, told before the work", "[program]") {
  const Junkyard junk;
  const auto output = [&](const std::string& name, const std::string& about) {
    // So many samples that the test would not end if it were told after the work.
    junk.check_fails({"render", "scene.json", "--spp", "16777216", "-o", name}, name + ": " + about);
  };
  output("missing/a.exr", "cannot be written: No such file or directory");
  output("floor.obj/a.exr", "cannot be written: Not a directory");
  output("folder.exr", "cannot be written: it is a directory");
  output("a.jpg", "cannot be written as an image: expected .exr, .hdr or .png");
  output("a", "cannot be written as an image: expected .exr, .hdr or .png");
  junk.check_fails({"render", "scene.json", "--spp", "16777216", "-o", "a.exr", "-o", "missing/a.png"},
                   "missing/a.png: cannot be written");
}

TEST_CASE("program: a directory without leave to write is one sentence", "[program]") {
  const Junkyard junk;
  if (geteuid() == 0) {
    WARN("skipped: the superuser may write anywhere");
    return;
  }
  std::filesystem::create_directory(junk.directory / "closed");
  std::filesystem::permissions(junk.directory / "closed",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  junk.check_fails({"render", "scene.json", "-o", "closed/a.exr"}, "closed/a.exr: cannot be written");
}

TEST_CASE("program: no input is overwritten, under whatever name", "[program]") {
  const Junkyard junk;
  const std::string before = content_of(junk.directory / "whole.exr");
  std::filesystem::create_symlink("whole.exr", junk.directory / "link.exr");
  const std::string texture = R"({"textures": {"sky": {"type": "image", "path": "whole.exr"}}})";
  for (const char* const name : {"whole.exr", "./whole.exr", "link.exr"}) {
    junk.check_fails({"render", "scene.json", "--override", texture, "-o", name},
                     std::string(name) + ": is an input: name another output");
  }
  const std::string png = R"({"textures": {"sky": {"type": "image", "path": "whole.png"}}})";
  junk.check_fails({"render", "scene.json", "--override", png, "-o", "folder.exr/../whole.exr"},
                   "whole.png: is an input: name another output");  // the PNG beside the EXR
  CHECK(content_of(junk.directory / "whole.exr") == before);
}
