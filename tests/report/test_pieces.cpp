// Colours of wavelengths, pieces of HTML and JSON, and what a page draws of a mesh.
#include "geometry/tessellate.h"
#include "report/colour.h"
#include "report/drawn_mesh.h"
#include "report/html.h"
#include "report/json_text.h"
#include "report/sample_run.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;
using namespace sahl::report;

TEST_CASE("wavelengths have the colours that people expect") {
    Rgb const blue = spectral_colour(486.1327e-9), yellow = spectral_colour(587.5618e-9),
              red = spectral_colour(656.2725e-9);
    CHECK(blue[2] > 0.8);
    CHECK(blue[2] > blue[1]);
    CHECK(blue[0] < 0.2);
    CHECK(yellow[0] > 0.9);
    CHECK(yellow[1] > 0.6);
    CHECK(yellow[2] < 0.1);
    CHECK(red[0] > 0.9);
    CHECK(red[1] < 0.2);
    CHECK(red[2] < 0.1);
    Rgb const green = spectral_colour(532e-9);
    CHECK(green[1] > 2.0 * green[0]);
    CHECK(green[1] > 2.0 * green[2]);
}

TEST_CASE("what cannot be seen is grey") {
    for (double const wavelength : {379.9e-9, 780.1e-9, 1064e-9, 0.0, -1.0, double(NAN), double(INFINITY)}) {
        Rgb const colour = spectral_colour(wavelength);
        CHECK(colour[0] == colour[1]);
        CHECK(colour[1] == colour[2]);
    }
    CHECK(spectral_colour(380e-9) != spectral_colour(379.9e-9));
    CHECK(spectral_colour(780e-9) != spectral_colour(780.1e-9));
}

TEST_CASE("colours of rays are dark enough on white and light enough on black") {
    for (int nm = 370; nm <= 790; ++nm) {
        CAPTURE(nm);
        Rgb const colour = spectral_colour(nm * 1e-9), dark = on_white(colour), light = on_black(colour);
        auto const luminance = [](Rgb const& c) {
            auto const linear = [](double v) {
                return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
            };
            return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
        };
        CHECK(luminance(dark) < 0.301);
        CHECK(luminance(light) > 0.149);
    }
    CHECK(hex({1.0, 0.5, 0.0}) == "#ff8000");
    CHECK(hex({2.0, -1.0, 0.0}) == "#ff0000");
}

TEST_CASE("coordinates are short, and text is escaped") {
    CHECK(coordinate(-0.001) == "0");
    CHECK(coordinate(12.5) == "12.5");
    CHECK(coordinate(100.0) == "100");
    CHECK(escaped("<a href=\"x\">'&'\x02") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;\uFFFD");
}

TEST_CASE("base64 is that of RFC 4648") {
    auto const encoded = [](std::string_view text) {
        std::string out;
        append_base64(out, {reinterpret_cast<unsigned char const*>(text.data()), text.size()});
        return out;
    };
    CHECK(encoded("") == ""); // section 10
    CHECK(encoded("f") == "Zg==");
    CHECK(encoded("fo") == "Zm8=");
    CHECK(encoded("foo") == "Zm9v");
    CHECK(encoded("foob") == "Zm9vYg==");
    CHECK(encoded("fooba") == "Zm9vYmE=");
    CHECK(encoded("foobar") == "Zm9vYmFy");
    CHECK(encoded("\xFF\xFE\xFB") == "//77");
}

TEST_CASE("JSON of a page has commas where they belong, and no bracket that could end it") {
    JsonText json;
    json.open('{')
        .entry("a<b", "</script>")
        .key("list")
        .open('[')
        .value(1.5)
        .value(std::uint64_t{2})
        .value(NAN);
    json.open('{')
        .close('}')
        .close(']')
        .array("x", std::vector<std::uint16_t>{1, 2})
        .entry("last", true)
        .close('}');
    std::string const text = json.take();
    CHECK(text.find('<') == std::string::npos);
    Value const read = parse_json(text, "text");
    CHECK(std::get<std::string>(read.find("a<b")->data) == "</script>");
    CHECK(std::get<Array>(read.find("list")->data).size() == 4);
    CHECK(std::get<std::string>(read.find("x")->find("u16")->data) == "AQACAA==");
    CHECK(std::get<bool>(read.find("last")->data));
}

TEST_CASE("a page draws the twelve edges of a cube, and the rim of a sheet") {
    Mesh const cube = sample::cube(0.005);
    TriangleSoup soup = cube.soup;
    soup.face_names = {"surface"};
    DrawnMesh const drawn = drawn_mesh(soup, 1000);
    CHECK(drawn.creases.size() == 2 * 12); // not the diagonals of its sides
    CHECK(drawn.borders.empty());
    CHECK(drawn.triangles.size() == 3 * 12);
    CHECK(drawn.places[0] == -5.0F); // mm
    Tessellation const disk = tessellate(Disk{0.01, 0.0}, 48);
    DrawnMesh const sheet = drawn_mesh(disk.soup, 10000);
    CHECK(sheet.creases.empty());
    CHECK(sheet.borders.size() == 2 * 48);
}

TEST_CASE("a lens has the edges of its rim, though no face of it has any") {
    Tessellation const lens = tessellate(Lens{0.05, -0.05, 0.006, 0.02}, 96);
    DrawnMesh const drawn = drawn_mesh(lens.soup, 100000);
    CHECK(drawn.face_begins.size() == 4);
    CHECK(drawn.face_begins.back() == drawn.triangles.size() / 3);
    CHECK(drawn.creases.size() == 2 * 2 * 96);
    CHECK(drawn.borders.empty());
    CHECK(drawn.normals.size() == drawn.places.size());
}

TEST_CASE("a mesh with too many triangles is drawn with fewer, as large as it was") {
    Tessellation const ball = tessellate(Sphere{0.01}, 600);
    std::size_t const all = ball.soup.triangles.size();
    REQUIRE(all > 50000);
    for (std::size_t const most : {std::size_t{20000}, std::size_t{3000}, std::size_t{300}}) {
        CAPTURE(most);
        DrawnMesh const drawn = drawn_mesh(ball.soup, most);
        CHECK(drawn.triangles_of_model == all);
        CHECK(drawn.triangles.size() / 3 <= most);
        CHECK(drawn.triangles.size() / 3 > most / 4);
        float low = 0.0F, high = 0.0F;
        for (float const x : drawn.places) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
        CHECK(low < -8.5F);
        CHECK(high > 8.5F);
        CHECK(drawn.borders.empty()); // corners went together with all of their triangles
    }
}
