// SPDX-License-Identifier: MIT
#include <glint/io/scene_draft.hpp>  // first, so the header proves it stands alone

#include <filesystem>
#include <map>
#include <string>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_scene_draft {

namespace {

using glint::IoError;
using glint::JsonValue;
using glint::detail::SceneDraft;
using glint::testing::JsonText;
using glint::testing::message_of;

template <typename Read>
std::string value_error(std::string_view text, Read&& read) {
  JsonText json(text);
  return message_of<IoError>([&] { (void)read(json.value("/x")); }, "scene.json:");
}

}  // namespace

TEST_CASE("scene draft: materials are numbered in their order, and black is added once", "[io][scene]") {
  SceneDraft draft;
  CHECK(draft.add_material(glint::Mirror{}) == 0);
  CHECK(draft.black_material() == 1);
  CHECK(draft.add_material(glint::Mirror{}) == 2);
  CHECK(draft.black_material() == 1);
  CHECK(draft.scene.materials.size() == 3);
}

TEST_CASE("scene draft: a name that nothing has is an error with the nearest that something has", "[io][scene]") {
  const std::map<std::string, int> known{{"grey", 1}, {"red", 2}};
  JsonText grey("\"grey\"");
  CHECK(glint::detail::named(known, grey.value(), "texture") == 1);
  const auto read = [&](const JsonValue& v) { return glint::detail::named(known, v, "texture"); };
  CHECK(value_error("\"gray\"", read) == "/x: there is no texture named \"gray\"; did you mean \"grey\"?");
  CHECK(value_error("\"marble\"", read) == "/x: there is no texture named \"marble\"");
  CHECK(value_error("7", read) == "/x: found 7, expected a string");
}

TEST_CASE("scene draft: paths are relative to the scene's folder, and noted as inputs", "[io][scene]") {
  const auto path_of = [](const char* text) {
    JsonText json(text);
    json.source.path = "scenes/room.json";
    SceneDraft draft;
    const auto path =
        glint::detail::read_named_file(draft, json.value(), [](const std::filesystem::path& p) { return p; });
    CHECK(draft.scene.inputs == std::vector{path});
    return path.string();
  };
  CHECK(path_of("\"a/b.obj\"") == "scenes/a/b.obj");
  CHECK(path_of("\"a\\\\b.obj\"") == "scenes/a/b.obj");
  CHECK(path_of("\"/a/b.obj\"") == "/a/b.obj");
}

TEST_CASE("scene draft: what is wrong with a file is told with its place in the scene", "[io][scene]") {
  SceneDraft draft;
  const auto read = [&](const JsonValue& v) {
    return glint::detail::read_named_file(
        draft, v, [](const std::filesystem::path& path) -> int { throw IoError(path, 12, "is odd"); });
  };
  CHECK(value_error("\"a.obj\"", read) == "/x: a.obj:12: is odd");
  CHECK(value_error("\"\"", read) == "/x: found \"\", expected the path of a file");
}

TEST_CASE("scene draft: transforms are 16 numbers, row by row", "[io][scene]") {
  JsonText json("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1]");
  const auto affine = glint::detail::affine_of(json.value());
  CHECK(affine.translation == glint::Vec3<float>(4, 8, 12));
  CHECK(affine.vector({1, 0, 0}) == glint::Vec3<float>(1, 5, 9));
  CHECK(affine.vector({0, 0, 1}) == glint::Vec3<float>(3, 7, 11));
  CHECK(value_error("[1, 2, 3]", glint::detail::affine_of) ==
        "/x: found an array of 3, expected an array of 16 numbers");
  CHECK(value_error("[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]", glint::detail::affine_of) ==
        "/x: found [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2], expected a last row of 0, 0, 0, 1");
}

TEST_CASE("scene draft: a direction has a length", "[io][scene]") {
  CHECK(value_error("[0, 0, 0]", glint::detail::direction_of) ==
        "/x: found an array of 3, expected a vector that is not zero");
}

}  // namespace test_io_scene_draft
