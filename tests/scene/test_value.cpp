// Values: TOML and JSON give the same tree, each value knows its place, and what is malformed is refused with
// one.
#include "scene/value.h"

#include "scene/read_text.h"
#include "support/catch.h"

#include <limits>

using namespace sahl;

namespace {

bool same(Value const& a, Value const& b) {
    if (auto const* array = std::get_if<Array>(&a.data)) {
        auto const* other = std::get_if<Array>(&b.data);
        return other && std::equal(array->begin(), array->end(), other->begin(), other->end(), same);
    }
    if (auto const* table = std::get_if<Table>(&a.data)) {
        auto const* other = std::get_if<Table>(&b.data);
        return other && std::equal(table->begin(), table->end(), other->begin(), other->end(),
                                   [](auto const& x, auto const& y) {
                                       return x.first == y.first && same(x.second, y.second);
                                   });
    }
    return to_json(a) == to_json(b) && a.data.index() == b.data.index();
}

std::string toml_error(std::string const& text) {
    return error_of([&] { parse_toml(text, "a.toml"); });
}

std::string json_error(std::string const& text) {
    return error_of([&] { parse_json(text, "a.json"); });
}

} // namespace

TEST_CASE("a TOML value knows the line and column of its key") {
    Value const tree = parse_toml("title = \"x\"\n\n[trace]\n  seed = 3\n", "a.toml");
    Value const* seed = tree.find("trace")->find("seed");
    REQUIRE(seed);
    CHECK(seed->place.text() == "a.toml:4:3");
    CHECK(std::get<std::int64_t>(seed->data) == 3);
}

TEST_CASE("an element of a TOML list knows its own place") {
    Value const tree = parse_toml("a = [1,\n  2.5]", "a.toml");
    CHECK(std::get<Array>(tree.find("a")->data)[1].place.text() == "a.toml:2:3");
}

TEST_CASE("a TOML table keeps the order of the file, not that of the alphabet") {
    Value const tree =
        parse_toml("surface.z = {absorb = true}\nsurface.a = {absorb = true}\nb = 1\n", "a.toml");
    auto const& surfaces = std::get<Table>(tree.find("surface")->data);
    CHECK(surfaces[0].first == "z");
    CHECK(surfaces[1].first == "a");
    CHECK(std::get<Table>(tree.data)[1].first == "b");
}

TEST_CASE("a TOML syntax error names its line") {
    CHECK(toml_error("a = 1\nb = \"open\nc = 2\n").rfind("a.toml:2:", 0) == 0);
    CHECK(toml_error("a = 1\na = 2\n").rfind("a.toml:2:", 0) == 0);
    CHECK(toml_error("a = 1979-05-27\n").find("date") != std::string::npos);
    CHECK(!toml_error("a = " + std::string(300, '[') + std::string(300, ']')).empty());
}

TEST_CASE("a JSON value knows its pointer") {
    Value const tree = parse_json(R"({"object": [{"name": "a"}, {"a/b~": [1, 2]}]})", "a.json");
    Value const& second = std::get<Array>(tree.find("object")->data)[1];
    CHECK(second.place.text() == "a.json: /object/1");
    CHECK(std::get<Array>(second.find("a/b~")->data)[1].place.pointer == "/object/1/a~1b~0/1");
}

TEST_CASE("a JSON syntax error names line and column") {
    CHECK(json_error("{\n  \"a\": 1,\n  \"b\": NaN\n}").rfind("a.json:3:8", 0) == 0);
    CHECK(json_error("{\n  \"a\": 1\n  \"b\": 2\n}").rfind("a.json:3:", 0) == 0);
    CHECK(json_error("").rfind("a.json:1:1", 0) == 0);
    CHECK(json_error("{} {}").rfind("a.json:1:", 0) == 0);
    CHECK(!json_error("{\"a\": 1e999}").empty());
    CHECK(!json_error("{\"a\": \"\xff\"}").empty());
}

TEST_CASE("a JSON key that stands twice is refused") {
    CHECK(json_error(R"({"a": {"b": 1, "b": 2}})").rfind("a.json: /a/b: ", 0) == 0);
}

TEST_CASE("256 levels of JSON are read, 257 are refused before anything is parsed") {
    auto const nested = [](std::size_t levels) {
        return std::string(levels, '[') + std::string(levels, ']');
    };
    CHECK(json_error(nested(256)).empty());
    CHECK(json_error(nested(257)).rfind("a.json:1:257", 0) == 0);
    CHECK(!json_error(std::string(1000000, '[')).empty());
    CHECK(json_error("[\"" + std::string(1000, '[') + "\\\"[\"]").empty()); // brackets in text are no levels
}

TEST_CASE("the same structure as TOML and as JSON is the same tree") {
    std::string const toml = "a = 1\nb = 1.0\nc = [true, \"x\"]\n[d]\ne = {f = [[1, 2], []], g = {}}\n";
    std::string const json =
        R"({"a": 1, "b": 1.0, "c": [true, "x"], "d": {"e": {"f": [[1, 2], []], "g": {}}}})";
    CHECK(same(parse_toml(toml, "a"), parse_json(json, "b")));
}

TEST_CASE("what to_json writes reads back as it was, doubles to the last bit") {
    Value const tree =
        parse_toml("a = 0.1\nb = 1e300\nc = 4.9406564584124654e-324\nd = 3.0\ne = 3\nf = -0.0\n"
                   "g = \"line\\n\\\"quoted\\\" λ\"\nh = [[1, 2.5], {x = []}]\ni = {}\n",
                   "a");
    CHECK(same(parse_json(to_json(tree), "b"), tree));
    CHECK(to_json(Value{0.1, {}}) == "0.1");
    CHECK(to_json(Value{587.5618, {}}) == "587.5618");
    CHECK(to_json(parse_toml("b = [1, 2]\na = {c = 1}\n", "")) ==
          "{\n  \"b\": [1, 2],\n  \"a\": {\n    \"c\": 1\n  }\n}");
}

TEST_CASE("a number that is not finite becomes null in JSON") {
    CHECK(to_json(Value{std::numeric_limits<double>::infinity(), {}}) == "null");
    CHECK(to_json(Value{std::numeric_limits<double>::quiet_NaN(), {}}) == "null");
}

TEST_CASE("a whole number beyond 64 bits with sign becomes a double") {
    Value const tree = parse_json("[9223372036854775807, 18446744073709551615]", "a");
    auto const& items = std::get<Array>(tree.data);
    CHECK(std::get<std::int64_t>(items[0].data) == std::numeric_limits<std::int64_t>::max());
    CHECK(std::get<double>(items[1].data) == 18446744073709551615.0);
}
