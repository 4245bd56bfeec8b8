// SPDX-License-Identifier: MIT
#include <glint/io/json_object.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_json_object {

namespace {

using glint::IoError;
using glint::JsonObject;
using glint::JsonValue;
using glint::Rgb;
using glint::detail::edit_distance;
using glint::detail::suggestion;
using glint::testing::JsonText;
using glint::testing::message_of;

/// What `read(value)` throws of a text that stands at /x.
template <typename Read>
std::string value_error(std::string_view text, Read&& read) {
  JsonText json(text);
  return message_of<IoError>([&] { (void)read(json.value("/x")); });
}

}  // namespace

TEST_CASE("json: the distance of two words is the least number of edits", "[io][json]") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("eta", "etta") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);  // the textbook's: k→s, e→i, +g
  CHECK(edit_distance("ab", "ba") == 2);           // an exchange of neighbors is two edits
}

TEST_CASE("json: a near word is suggested, a far one is not", "[io][json]") {
  const std::vector<std::string> words{"eta", "texture_name", "twosided"};
  CHECK(suggestion("etta", words) == "; did you mean \"eta\"?");
  CHECK(suggestion("textur_nam", words) == "; did you mean \"texture_name\"?");
  CHECK(suggestion("radiance", words).empty());
  CHECK(suggestion("eta", {}).empty());
}

TEST_CASE("json: a number is any that a float can hold", "[io][json]") {
  const auto number = [](const char* text) {
    JsonText json(text);
    return json.value().number();
  };
  CHECK(number("3") == 3);
  CHECK(number("-0.5") == -0.5F);
  CHECK(number("1e-300") == 0);
  const auto read = [](const JsonValue& v) { return v.number(); };
  CHECK(value_error("1e39", read) == "scene.json:/x: found 1e+39, expected a number that a 32-bit float can hold");
  CHECK(value_error("\"1\"", read) == "scene.json:/x: found \"1\", expected a number");
  CHECK(value_error("null", read) == "scene.json:/x: found null, expected a number");
  CHECK(value_error("{}", read) == "scene.json:/x: found an object, expected a number");
  CHECK(value_error("[1, 2]", read) == "scene.json:/x: found an array of 2, expected a number");
}

TEST_CASE("json: a real without a fraction is an integer", "[io][json]") {
  JsonText json("32.0");
  CHECK(json.value().integer(1) == 32);
  const auto read = [](const JsonValue& v) { return v.integer(1, 100); };
  const std::string expected = ", expected an integer from 1 to 100";
  for (const char* const text : {"32.5", "0", "-3", "101", "1e30", "-1e30"}) {
    CAPTURE(text);
    CHECK(value_error(text, read).ends_with(expected));
  }
  CHECK(value_error("0", read) == "scene.json:/x: found 0" + expected);
  CHECK(value_error("true", read) == "scene.json:/x: found true" + expected);
  const auto open_ended = [](const JsonValue& v) { return v.integer(1); };
  CHECK(value_error("99999999999", open_ended) == "scene.json:/x: found 99999999999, expected an integer from 1 up");
}

TEST_CASE("json: a seed is any integer of 64 bits", "[io][json]") {
  const auto seed = [](const char* text) {
    JsonText json(text);
    return json.value().seed();
  };
  CHECK(seed("0") == 0);
  CHECK(seed("18446744073709551615") == UINT64_MAX);
  CHECK(seed("5.0") == 5);
  const auto read = [](const JsonValue& v) { return v.seed(); };
  for (const char* const text : {"-1", "0.5", "18446744073709551616", "\"7\"", "-0.5"}) {
    CAPTURE(text);
    CHECK(value_error(text, read).ends_with(", expected an integer from 0 to 2^64 - 1"));
  }
}

TEST_CASE("json: flags and texts are taken as they are", "[io][json]") {
  JsonText yes("true");
  CHECK(yes.value().flag());
  JsonText word("\"a\\nb\"");
  CHECK(word.value().text() == "a\nb");
  CHECK(value_error("1", [](const JsonValue& v) { return v.flag(); }) ==
        "scene.json:/x: found 1, expected true or false");
  CHECK(value_error("1", [](const JsonValue& v) { return v.text(); }) == "scene.json:/x: found 1, expected a string");
}

TEST_CASE("json: vectors and colors have exactly their numbers", "[io][json]") {
  JsonText two("[1, 2.5]");
  CHECK(two.value().vec2() == glint::Vec2<float>(1, 2.5F));
  JsonText three("[1, 0, 2.5]");
  CHECK(three.value().vec3() == glint::Vec3<float>(1, 0, 2.5F));
  CHECK(three.value().color() == Rgb{1, 0, 2.5F});
  const auto vector = [](const JsonValue& v) { return v.vec3(); };
  CHECK(value_error("[1, 2]", vector) == "scene.json:/x: found an array of 2, expected an array of 3 numbers");
  CHECK(value_error("1", vector) == "scene.json:/x: found 1, expected an array of 3 numbers");
  CHECK(value_error("[1, \"2\", 3]", vector) == "scene.json:/x/1: found \"2\", expected a number");
  const auto color = [](const JsonValue& v) { return v.color(); };
  CHECK(value_error("[1, -0.5, 1]", color) == "scene.json:/x: found [1,-0.5,1], expected three numbers from 0 up");
}

TEST_CASE("json: long values are told in short", "[io][json]") {
  const std::string word(100, 'a');
  const auto message = value_error("\"" + word + "\"", [](const JsonValue& v) { return v.number(); });
  CHECK(message == "scene.json:/x: found \"" + word.substr(0, 36) + "..., expected a number");
}

TEST_CASE("json object: what is not an object is an error at its place", "[io][json]") {
  JsonText json("[]");
  CHECK(message_of<IoError>([&] { (void)json.object("/film"); }) ==
        "scene.json:/film: found an array of 0, expected an object");
  CHECK(message_of<IoError>([&] { (void)json.object(); }) == "scene.json: found an array of 0, expected an object");
}

TEST_CASE("json object: a key that is there is read, one that is not has its default", "[io][json]") {
  JsonText json(R"({"number": 2, "integer": 3, "flag": true, "text": "t", "two": [1, 2], "three": [1, 2, 3]})");
  JsonObject object = json.object();
  CHECK(object.has("number"));
  CHECK_FALSE(object.has("other"));
  CHECK(object.number_or("number", 7) == 2);
  CHECK(object.number_or("other", 7) == 7);
  CHECK(object.integer_or("integer", 7, 1) == 3);
  CHECK(object.integer_or("other", 7, 1) == 7);
  CHECK(object.flag_or("flag", false));
  CHECK_FALSE(object.flag_or("other", false));
  CHECK(object.text_or("text", "u") == "t");
  CHECK(object.text_or("other", "u") == "u");
  CHECK(object.vec2_or("two", {7, 7}) == glint::Vec2<float>(1, 2));
  CHECK(object.vec3_or("other", {7, 8, 9}) == glint::Vec3<float>(7, 8, 9));
  CHECK(object.color_or("three", 1) == Rgb{1, 2, 3});
  CHECK(object.color_or("other", 1) == Rgb{1});
  CHECK(object.positive_or("number", 1) == 2);
  CHECK(object.not_negative_or("other", 0) == 0);
  CHECK(object.items("three").size() == 3);
  CHECK(object.items("three")[1].pointer() == "/three/1");
  CHECK(object.items("other").empty());
}

TEST_CASE("json object: wrong values are errors at their own place", "[io][json]") {
  JsonText json(R"({"zero": 0, "minus": -1, "word": "w"})");
  JsonObject object = json.object("/a");
  const auto message = [&](auto read) { return message_of<IoError>([&] { (void)read(); }); };
  CHECK(message([&] { return object.positive_or("zero", 1); }) ==
        "scene.json:/a/zero: found 0, expected a number above 0");
  CHECK(message([&] { return object.not_negative_or("minus", 1); }) ==
        "scene.json:/a/minus: found -1, expected a number from 0 up");
  CHECK(message([&] { return object.positive_or("word", 1); }) ==
        "scene.json:/a/word: found \"w\", expected a number above 0");
  CHECK(message([&] { return object.items("word"); }) == "scene.json:/a/word: found \"w\", expected an array");
  CHECK(message([&] { return object.require("path"); }) == "scene.json:/a: the key \"path\" is missing");
}

TEST_CASE("json object: keys that nobody asked for are warned of, with the nearest that was", "[io][json]") {
  JsonText json(R"({"etta": 1, "type": "x", "a/b~c": 2})");
  JsonObject object = json.object("/materials/glass");
  (void)object.number_or("eta", 1);
  object.ignore({"type"});
  object.finish();
  CHECK(json.source.warnings ==
        std::vector<std::string>{"scene.json:/materials/glass/a~1b~0c: unknown key",
                                 "scene.json:/materials/glass/etta: unknown key; did you mean \"eta\"?"});
}

TEST_CASE("json object: where the source is strict an unknown key is an error", "[io][json]") {
  JsonText json(R"({"etta": 1})");
  json.source.strict = true;
  JsonObject object = json.object();
  CHECK(message_of<IoError>([&] { object.finish(); }) == "scene.json:/etta: unknown key");
  CHECK(json.source.warnings.empty());
  json.source.note("/etta", "is remarkable");
  CHECK(json.source.warnings == std::vector<std::string>{"scene.json:/etta: is remarkable"});
}

TEST_CASE("json object: members are asked for all at once", "[io][json]") {
  JsonText json(R"({"b": 1, "a": 2})");
  JsonObject object = json.object("/m");
  const auto members = object.members();
  REQUIRE(members.size() == 2);
  CHECK(members[0].first == "a");
  CHECK(members[0].second.pointer() == "/m/a");
  CHECK(members[1].second.integer(0) == 1);
  object.finish();
  CHECK(json.source.warnings.empty());
}

}  // namespace test_io_json_object
