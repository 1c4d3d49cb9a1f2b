// Catalogues of a user's own: what is read of them, and what is refused with which words.
#include "materials/catalogue_files.h"
#include "math/input_error.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;

namespace {

std::string const agf_text =
    "CC a catalogue of two\r\n"
    "NM BK 2 517642.251 1.5168 64.17 0 1 2\r\n"
    "GC a comment with numbers 1 2 nan\r\n"
    "CD 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653 0 0 0 0\r\n"
    "TD 1.86E-6 1.31E-8 -1.37E-11 4.34E-7 6.27E-10 0.17 20\r\n"
    "OD -1 1 2 1 2 2.3\r\n"
    "LD +3.0E-01 2.5\r\n"
    "IT 0.5 0.99 25\r\n"
    "IT 0.4 0.9 10\r\n"
    "IT 0.3 0 10\r\n"
    "IT 2.0\r\n"
    "NM MINE 5 0 0 0\r\n"
    "CD 1.6 0.01 0.001\r\n"
    "LD 0.4 0.8\r\n";

std::string const page_text =
    "# a comment: with a colon\n"
    "REFERENCES: |\n"
    "    Somebody.\n"
    "    DATA: this stands within a text\n"
    "COMMENTS: \"20 °C\"\n"
    "DATA:\n"
    "  - type: formula 2\n"
    "    wavelength_range: 0.3 2.5\n"
    "    coefficients: 0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653\n"
    "  - type: tabulated k\n"
    "    data: |\n"
    "        0.400 1.0E-08\n"
    "        0.300 2.0E-06\n";

GlassEntry page(std::string const& text) {
    return read_material_page(text, "page.yml", "page");
}

std::string refusal(std::string const& text, bool is_page) {
    try {
        if (is_page)
            page(text);
        else
            read_agf(text, "my.agf", "my");
    } catch (InputError const& error) {
        return error.what();
    }
    return "accepted";
}

std::string with(std::string text, std::string const& old, std::string const& fresh) {
    auto const at = text.find(old);
    REQUIRE(at != text.npos);
    return text.replace(at, old.size(), fresh);
}

bool starts(std::string const& text, std::string const& start) {
    CAPTURE(text);
    return text.rfind(start, 0) == 0;
}

} // namespace

TEST_CASE("an AGF file gives its glasses with formula, range and absorption") {
    auto const glasses = read_agf(agf_text, "my.agf", "my");
    REQUIRE(glasses.size() == 2);
    CHECK(glasses[0].full_name() == "my:BK");
    CHECK(refractive_index(glasses[0].medium.index, 587.5618e-9) == Approx(1.5168).margin(5e-7));
    CHECK(glasses[0].nd == 1.5168);
    CHECK(glasses[0].medium.range.first == Approx(0.3e-6));
    CHECK(glasses[0].medium.range.second == Approx(2.5e-6));
    CHECK(glasses[0].formula == "AGF formula 2, Sellmeier 1");
    auto const& absorption = glasses[0].medium.absorption;
    REQUIRE(absorption.size() == 3);
    CHECK(absorption_coefficient(glasses[0].medium, 0.5e-6) == Approx(-std::log(0.99) / 25e-3));
    CHECK(std::exp(-10e-3 * absorption_coefficient(glasses[0].medium, 0.4e-6)) == Approx(0.9));
    CHECK(std::exp(-10e-3 * absorption.front().second) == Approx(1e-6)); // a printed 0
    CHECK(refractive_index(glasses[1].medium.index, 0.5e-6) ==
          Approx(1.6 + 0.01 / 0.5 + 0.001 / std::pow(0.5, 3.5)).epsilon(1e-14));
    CHECK(glasses[1].medium.absorption.empty());
}

TEST_CASE("an AGF file in UTF-16 is the same file") {
    std::string wide = "\xFF\xFE";
    for (char const c : agf_text)
        wide += std::string{c, '\0'};
    CHECK(read_agf(wide, "my.agf", "my").size() == 2);
    CHECK(read_agf(wide.substr(2), "my.agf", "my").size() == 2); // without the mark before it
}

TEST_CASE("of two transmittances at one wavelength that of the thicker piece counts") {
    auto const twice =
        read_agf(with(agf_text, "IT 0.5 0.99 25", "IT 0.5 0.996 10\nIT 0.5 0.99 25"), "my.agf", "my");
    CHECK(absorption_coefficient(twice[0].medium, 0.5e-6) == Approx(-std::log(0.99) / 25e-3));
    auto const dark =
        read_agf(with(agf_text, "IT 0.5 0.99 25", "IT 0.5 0.1 10\nIT 0.5 0 25"), "my.agf", "my");
    CHECK(absorption_coefficient(dark[0].medium, 0.5e-6) == Approx(-std::log(0.1) / 10e-3));
}

TEST_CASE("what is wrong in an AGF file is told with its line") {
    CHECK(starts(refusal("", false), "my.agf: there is no glass in this file"));
    CHECK(starts(refusal("NM\n", false), "my.agf:1: this glass has formula \"\""));
    CHECK(starts(refusal("NM A 14\n", false), "my.agf:1: this glass has formula \"14\""));
    CHECK(starts(refusal("NM A 2.5\n", false), "my.agf:1: this glass has formula \"2.5\""));
    CHECK(starts(refusal("NM A 1e300\n", false), "my.agf:1: this glass has formula \"1e300\""));
    CHECK(starts(refusal("\nNM A 2\n", false), "my.agf:2: \"A\" has no coefficients"));
    CHECK(starts(refusal(with(agf_text, "1.03961212", "nan"), false),
                 "my.agf:4: \"nan\" is not a finite number"));
    CHECK(starts(refusal(with(agf_text, "1.03961212", "1,039"), false), "my.agf:4: \"1,039\" is not"));
    CHECK(starts(refusal(with(agf_text, "1.03961212", "1e999"), false), "my.agf:4: \"1e999\" is not"));
    CHECK(starts(refusal(with(agf_text, "0 0 0 0\r\nTD", "0 0 0 0 0\r\nTD"), false),
                 "my.agf:2: \"BK\" has more than ten coefficients"));
    CHECK(starts(refusal(with(agf_text, "LD +3.0E-01 2.5", "LD 2.5 0.3"), false), "my.agf:2: the range"));
    CHECK(starts(refusal(with(agf_text, "LD +3.0E-01 2.5\r\n", ""), false), "my.agf:2: \"BK\" has no range"));
    CHECK(starts(refusal(with(agf_text, "IT 0.5 0.99 25", "IT 0.5 1.01 25"), false),
                 "my.agf:8: this transmittance"));
    CHECK(starts(refusal(with(agf_text, "IT 0.5 0.99 25", "IT 0.5 0.99 0"), false),
                 "my.agf:8: this transmittance"));
    CHECK(
        starts(refusal(with(agf_text, "CD 1.6", "CD -1.6"), false), "my.agf:12: \"MINE\" has no real index"));
}

TEST_CASE("a page of refractiveindex.info gives its material with formula, range and absorption") {
    GlassEntry const glass = page(page_text);
    CHECK(glass.full_name() == "page");
    CHECK(refractive_index(glass.medium.index, 587.5618e-9) == Approx(1.5168).margin(5e-7));
    CHECK(glass.medium.range.second == Approx(2.5e-6));
    REQUIRE(glass.medium.absorption.size() == 2);
    CHECK(glass.medium.absorption.front().first == Approx(0.3e-6));
    CHECK(absorption_coefficient(glass.medium, 0.4e-6) == Approx(4 * 3.14159265358979 * 1e-8 / 0.4e-6));
}

TEST_CASE("a page may tabulate n and k") {
    GlassEntry const table =
        page("DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.5 1e-7\n        0.6 1.4 0\n"
             "        0.6 1.4 0\n");
    CHECK(refractive_index(table.medium.index, 0.5e-6) == Approx(1.45));
    CHECK(absorption_coefficient(table.medium, 0.6e-6) == 0.0);
    CHECK(table.medium.range.first == Approx(0.4e-6));
    CHECK(
        page("DATA:\n- type: tabulated n\n  data: |\n    0.4 1.5\n    0.6 1.4\n").medium.absorption.empty());
}

TEST_CASE("a page that says that its index is relative to vacuum is understood so") {
    double const n = refractive_index(page(page_text).medium.index, 500e-9),
                 air = 1 / refractive_index(VacuumIndex{}, 500e-9);
    for (std::string const section : {"SPECS", "CONDITIONS"}) {
        std::string const text =
            page_text + section + ":\n    n_is_absolute: true\n    wavelength_is_vacuum: false\n";
        CHECK(refractive_index(page(text).medium.index, 500e-9) == Approx(n / air).epsilon(1e-15));
    }
    std::string const both = page_text + "SPECS:\n  n_is_absolute: true\n  wavelength_is_vacuum: true\n";
    double const in_vacuum = refractive_index(page(page_text).medium.index, 500e-9 * air);
    CHECK(refractive_index(page(both).medium.index, 500e-9) == Approx(in_vacuum / air).epsilon(1e-15));
    // Gases are divided by the index of air whatever is said: their formula is absolute.
    std::string const gas = "DATA:\n  - type: formula 6\n    wavelength_range: 0.23 1.69\n"
                            "    coefficients: 0 0.05792105 238.0185 0.00167917 57.362\n";
    CHECK(refractive_index(page(gas).medium.index, 500e-9) == 1.0);
    CHECK(refractive_index(page(gas + "SPECS:\n  n_is_absolute: true\n").medium.index, 500e-9) == 1.0);
}

TEST_CASE("what is wrong in a page is told with its line") {
    CHECK(starts(refusal("", true), "page.yml: this page gives no refractive index"));
    CHECK(starts(refusal("DATA:\n  - type: tabulated k\n    data: |\n        0.4 1e-7\n", true),
                 "page.yml: this page gives no refractive index"));
    CHECK(
        starts(refusal(with(page_text, "formula 2", "formula x"), true), "page.yml:7: this is no formula x"));
    CHECK(starts(refusal(with(page_text, "formula 2", "model 2"), true),
                 "page.yml:7: there is no type \"model 2\""));
    CHECK(starts(refusal(with(page_text, "0 1.03961212", "1.03961212"), true),
                 "page.yml:7: this is no formula 2 with 6 coefficients"));
    CHECK(starts(refusal(with(page_text, "0 1.03961212", "0 .inf"), true), "page.yml:7: \".inf\" is not"));
    CHECK(
        starts(refusal(with(page_text, "0.3 2.5", "0.3"), true), "page.yml:7: wavelength_range is not two"));
    CHECK(starts(refusal(with(page_text, "0.3 2.5", "0 2.5"), true), "page.yml: the range"));
    CHECK(starts(refusal(with(page_text, "0.300 2.0E-06", "0.300"), true), "page.yml:13: this is no row"));
    CHECK(starts(refusal(with(page_text, "0.300 2.0E-06", "0.300 -1"), true), "page.yml:13: this is no row"));
    CHECK(starts(refusal(with(page_text, "0.300 2.0E-06", "0.400 2E-6"), true),
                 "page.yml:10: a wavelength occurs"));
    CHECK(starts(refusal(with(page_text, "type: tabulated k", "{type: tabulated k"), true), "page.yml:10"));
    CHECK(starts(refusal(with(page_text, "  - type: formula 2", "    type: formula 2"), true),
                 "page.yml:7: this stands in no entry"));
    std::string const k_again = "  - type: tabulated k\n    data: |\n        0.500 1.0E-08\n";
    CHECK(starts(refusal(page_text + k_again, true), "page.yml:14: this page gives k more than once"));
}

TEST_CASE("of the two readings of an AGF file's Sellmeier 2 the one that gives its n_d is meant") {
    double const squared = 587.5618e-3 * 587.5618e-3, a = 0.6, b1 = 0.9, l1 = 0.1, b2 = 0.4, l2 = 8.0;
    double const with = std::sqrt(1.0 + a + b1 * squared / (squared - l1 * l1) +
                                  b2 * squared / (squared - l2 * l2)),
                 without = std::sqrt(1.0 + a + b1 * squared / (squared - l1 * l1) + b2 / (squared - l2 * l2));
    REQUIRE(std::abs(with - without) > 1e-3);
    auto const index = [&](double nd) {
        std::string const text = "NM X 4 0 " + std::to_string(nd) + " 50\nCD 0.6 0.9 0.1 0.4 8\nLD 0.4 1\n";
        return refractive_index(read_agf(text, "my.agf", "my").front().medium.index, 587.5618e-9);
    };
    CHECK(index(with) == Approx(with).epsilon(1e-14));
    CHECK(index(without) == Approx(without).epsilon(1e-14));
    CHECK(index(1.7) == Approx(without).epsilon(1e-14)); // neither
    CHECK(index(0.0) == Approx(without).epsilon(1e-14)); // not said
}
