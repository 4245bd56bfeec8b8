// SPDX-License-Identifier: MIT
#include <glint/io/json_parse.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_json_parse {

namespace {

using glint::IoError;
using glint::JsonSource;
using glint::merge_json;
using glint::parse_json;
using glint::testing::message_of;
using nlohmann::json;

std::string parse_error(const std::string& text) {
  JsonSource source{.path = "scene.json"};
  return message_of<IoError>([&] { (void)parse_json(text, source); });
}

json merged(const char* target, const char* source) {
  json result = json::parse(target);
  merge_json(result, json::parse(source));
  return result;
}

}  // namespace

TEST_CASE("json: text becomes the value that the library's own parser makes of it", "[io][json]") {
  JsonSource source{.path = "scene.json"};
  for (const char* const text :
       {"null", "true", "-3", "18446744073709551615", "2.5", "\"a\\u00e9\\n\"", "[]", "{}", "[[], {}, [1, [2]]]",
        R"({"a": [1, {"b": null, "c": [true, "x", -1e-3]}, 2], "": {"d": {}}})"}) {
    CAPTURE(text);
    CHECK(parse_json(text, source) == json::parse(text));
    CHECK(parse_json(text, source).type() == json::parse(text).type());
  }
  CHECK(source.warnings.empty());
}

TEST_CASE("json: a byte order mark is passed over", "[io][json]") {
  JsonSource source{.path = "scene.json"};
  CHECK(parse_json("\xEF\xBB\xBF{\"a\": 1}", source) == json{{"a", 1}});
}

TEST_CASE("json: text that is not JSON is an error with its line", "[io][json]") {
  CHECK(parse_error("{\n  \"a\": 1,\n  \"b\" 2\n}").starts_with("scene.json:3: is not JSON: syntax error"));
  CHECK(parse_error("").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(parse_error("{\"a\": 1").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(parse_error("{}\n\n{}").starts_with("scene.json:3: is not JSON: syntax error"));
  CHECK(parse_error("{ // a comment\n}").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(parse_error("[NaN]").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(parse_error("[\"\xFF\"]").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(parse_error("[1,\n1e999]") == "scene.json:2: is not JSON: number overflow parsing '1e999'");
}

TEST_CASE("json: an error is one line of bounded length, whatever the text", "[io][json]") {
  for (const std::string& text : {"[\"" + std::string(5000, 'a'), std::string("[\n\n\x01\n"), std::string("[\"a\nb\"]"),
                                  "[" + std::string(5000, '9') + "e999]"}) {
    const std::string message = parse_error(text);
    CAPTURE(message);
    CHECK(message.starts_with("scene.json:"));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 250);
  }
}

TEST_CASE("json: nesting has a limit, so that no stack overflows", "[io][json]") {
  JsonSource source{.path = "scene.json"};
  CHECK_NOTHROW(parse_json(std::string(64, '[') + std::string(64, ']'), source));
  const std::string problem = "scene.json: is nested too deeply, expected at most 64 levels";
  CHECK(parse_error(std::string(65, '[') + std::string(65, ']')) == problem);
  CHECK(parse_error(std::string(1000000, '[')) == problem);
}

TEST_CASE("json: a key that comes twice is warned of, and the last value counts", "[io][json]") {
  JsonSource source{.path = "scene.json"};
  CHECK(parse_json(R"({"a": [0, {"b": [1], "c": 2, "b": [2]}]})", source) ==
        json::parse(R"({"a":[0,{"b":[2],"c":2}]})"));
  CHECK(source.warnings ==
        std::vector<std::string>{"scene.json:/a/1/b: the key comes twice, and only its last value counts"});
  JsonSource strict{.path = "scene.json", .strict = true};
  CHECK(message_of<IoError>([&] { (void)parse_json(R"({"a": 1, "a": 1})", strict); }) ==
        "scene.json:/a: the key comes twice, and only its last value counts");
}

TEST_CASE("json: objects merge key by key, everything else is replaced", "[io][json]") {
  CHECK(merged(R"({"a": {"b": 1, "c": 2}})", R"({"a": {"b": 3}})") == json::parse(R"({"a": {"b": 3, "c": 2}})"));
  CHECK(merged(R"({"a": [1, 2, 3]})", R"({"a": [4]})") == json::parse(R"({"a": [4]})"));
  CHECK(merged(R"({"a": {"b": 1}})", R"({"a": 2})") == json::parse(R"({"a": 2})"));
  CHECK(merged(R"({"a": 2})", R"({"a": {"b": 1}})") == json::parse(R"({"a": {"b": 1}})"));
  CHECK(merged(R"({"a": 1})", R"({"d": {"e": 1}})") == json::parse(R"({"a": 1, "d": {"e": 1}})"));
  CHECK(merged(R"({"a": 1})", "{}") == json::parse(R"({"a": 1})"));
}

}  // namespace test_io_json_parse
