// Numbers, colours and the ledger's bar as they stand on the page.
#include "report/colour.h"
#include "report/html.h"
#include "report/ledger.h"
#include "report/sample_run.h"
#include "support/catch.h"

#include <cmath>
#include <numeric>

using namespace sahl;
using namespace sahl::report;

namespace {

/// All widths that the bar really has.
double sum_of_widths(std::string const& html) {
    double sum = 0.0;
    for (auto at = html.find("width:"); at != std::string::npos; at = html.find("width:", at + 1))
        sum += std::stod(html.substr(at + 6));
    return sum;
}

} // namespace

TEST_CASE("the parts of the ledger's bar add up to the whole") {
    Value summary = sample::summary();
    CHECK(sum_of_widths(ledger_html(summary)) == Approx(100.0).margin(1e-6));
    auto const widths = bar_widths(summary);
    REQUIRE(widths);
    CHECK((*widths)[0] == Approx(81.23456));
    CHECK((*widths)[4] == 0.0);

    sample::entry(summary, {"energy_W", "error"}).data = 3.0; // more than was emitted: the bar still adds up
    sample::entry(summary, {"energy_W", "cut"}).data = std::monostate{};
    CHECK(sum_of_widths(ledger_html(summary)) == Approx(100.0).margin(1e-6));

    for (char const* term : ledger_terms)
        sample::entry(summary, {"energy_W", term}).data = 0.0;
    CHECK_FALSE(bar_widths(summary));
}

TEST_CASE("the ledger closes up to its limit and not above") {
    Value summary = sample::summary();
    CHECK(ledger_closes(summary) == true);
    sample::entry(summary, {"energy_W", "remainder"}).data = -1e-12;
    CHECK(ledger_closes(summary) == true);
    sample::entry(summary, {"energy_W", "remainder"}).data = -1.01e-12;
    CHECK(ledger_closes(summary) == false);
    sample::entry(summary, {"options", "limit_ledger"}).data = 1e-9;
    CHECK(ledger_closes(summary) == true);
    sample::entry(summary, {"energy_W", "remainder"}).data = std::monostate{};
    CHECK(ledger_closes(summary) == false);
    CHECK_FALSE(ledger_closes(Value{}));

    CHECK(leaks_within_limit(summary) == true);
    sample::entry(summary, {"events", "leak"}).data = std::int64_t{1}; // of 18 735
    CHECK(leaks_within_limit(summary) == false);
}

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

TEST_CASE("numbers read as a person writes them") {
    CHECK(figure(0.8123456) == "0.812346");
    CHECK(figure(-0.25) == "−0.25");
    CHECK(figure(1.5e-7) == "1.5×10<sup>−7</sup>");
    CHECK(figure(2e12) == "2×10<sup>12</sup>");
    CHECK(figure(0.0) == "0");
    CHECK(figure(-0.0) == "0");
    CHECK(figure(double(NAN)) == "not finite");
    CHECK(count(0) == "0");
    CHECK(count(999) == "999");
    CHECK(count(1234567) == "1\u202F234\u202F567");
    CHECK(coordinate(-0.001) == "0");
    CHECK(coordinate(12.5) == "12.5");
    CHECK(coordinate(100.0) == "100");
    CHECK(per_cent(0.5) == "50 %");
}

TEST_CASE("rounding in a list is shown as 0, in a number of its own as it is") {
    Value const list = parse_json("[1.5, -2e-24, 0.0]", "list"), number = parse_json("-2e-24", "number");
    CHECK(shown(&list) == "(1.5, 0, 0)");
    CHECK(shown(&number) == "−2×10<sup>−24</sup>");
    CHECK(shown(nullptr) == "–");
}

TEST_CASE("text is cut between characters, and paths cannot become addresses") {
    CHECK(shortened("größer", 6) == "größer");
    CHECK(shortened("größer", 5) == "größ…");
    CHECK(escaped("<a href=\"x\">'&'\x02") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;\uFFFD");
    CHECK(relative_url("javascript:alert(1)") == "javascript%3Aalert%281%29");
    CHECK(relative_url("detectors/a b?c#d%.png") == "detectors/a%20b%3Fc%23d%25.png");
    CHECK(relative_url("grün") == "gr%C3%BCn");
}
