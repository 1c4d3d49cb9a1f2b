// Pictures whose every pixel, or whose mean, is known beforehand.
#include "run/render_scene.h"
#include "scene/read_text.h"
#include "support/catch.h"

#include <cmath>
#include <numeric>

using namespace sahl;

namespace {

RenderOutcome render(std::string const& toml, unsigned threads = 2) {
    Experiment experiment = read_text(toml);
    Scene scene = build_scene(experiment);
    PictureMaker const maker(scene, *experiment.picture, experiment.trace);
    std::atomic<bool> const never{false};
    return render_scene(maker, experiment.picture->options, threads, {}, never);
}

/// Largest distance of any pixel's colour from the given one.
double farthest(Film const& film, dvec3 const& colour) {
    double most = 0.0;
    for (FilmPixel const& pixel : film.pixels)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(film.mean(pixel)[c] - colour[c]));
    return most;
}

std::string const white = "[background]\ncolor = [1, 1, 1]\n";
std::string const furnace_camera = "[camera]\nat_mm = [10, 20, 100]\nlook_at_mm = [0, 0, 0]\nfov_deg = 20\n"
                                   "resolution = [32, 24]\nsamples = 2\n";

} // namespace

TEST_CASE("a lossless body of glass in a uniform white surround vanishes", "[render]") {
    // what is cut is all that is missing: with a cut at 1e-6 less than 1e-3 of any ray
    for (char const* shape : {"sphere = {radius_mm = 15}", "box = {size_mm = [20, 24, 18]}",
                              "cylinder = {radius_mm = 9, length_mm = 22}",
                              "lens = {r1_mm = 30, r2_mm = -40, thickness_mm = 9, diameter_mm = 22}",
                              "cone = {radius_mm = 12, top_radius_mm = 5, length_mm = 20}"}) {
        RenderOutcome const outcome = render("[[object]]\nname = \"body\"\nshape = {" + std::string(shape) +
                                             "}\nmedium = \"m\"\nturn_deg = [20, 33, 0]\n[medium.m]\nn = "
                                             "1.5\n[trace]\nmax_depth = 200\nmin_power = 1e-6\n" +
                                             furnace_camera + white);
        INFO(shape);
        CHECK(outcome.ended[static_cast<std::size_t>(Event::refracted)] > 100);
        CHECK(farthest(outcome.film, dvec3(1.0)) < 1e-3);
    }
}

TEST_CASE("colours of what does not disperse are the same with wavelengths and without", "[render]") {
    std::string const scene =
        "[surface.red]\npaint = {diffuse = [0.9, 0.3, 0.1], ambient = [0.1, 0.4, 0.2]}\n"
        "[[object]]\nname = \"wall\"\nshape = {rectangle = {size_mm = [80, 80]}}\nsurface = \"red\"\n"
        "move_mm = [0, 0, -30]\n"
        "[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 15}}\nmedium = \"m\"\n[medium.m]\nn = "
        "1.5\n"
        "[[light]]\npoint = {at_mm = [50, 80, 60]}\nintensity = [0.9, 1, 0.7]\n"
        "[background]\ncolor = [0.1, 0.2, 0.5]\n[trace]\nmin_power = 1e-4\n" +
        furnace_camera;
    RenderOutcome const one = render(scene + "[picture]\nwavelengths = 1\n");
    RenderOutcome const many = render(scene + "[picture]\nwavelengths = 6\n");
    double most = 0.0, brightest = 0.0;
    for (std::size_t i = 0; i < one.film.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            most = std::max(most, std::abs(one.film.mean(one.film.pixels[i])[c] -
                                           many.film.mean(many.film.pixels[i])[c]));
            brightest = std::max(brightest, one.film.mean(one.film.pixels[i])[c]);
        }
    CHECK(brightest > 0.4);
    CHECK(most < 1e-12); // the same sums in another order, of some ten terms that matrices amplify tenfold
}

TEST_CASE("the picture is the same for any number of threads", "[render]") {
    std::string const scene =
        "[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 15}}\nmedium = \"N-SF11\"\n"
        "[background]\ncolor = [0.1, 0.2, 0.5]\nzenith = [1, 1, 1]\n"
        "[trace]\nbranch = \"roulette\"\n[picture]\nadaptive = 0.02\n" +
        furnace_camera;
    RenderOutcome const one = render(scene, 1), three = render(scene, 3);
    bool same = true;
    for (std::size_t i = 0; i < one.film.pixels.size(); ++i)
        same = same && one.film.pixels[i].light == three.film.pixels[i].light &&
               one.film.pixels[i].samples == three.film.pixels[i].samples;
    CHECK(same);
    CHECK(one.ended == three.ended);
}

TEST_CASE("a sphere that absorbs shows the mean over its disc that theory has", "[render]") {
    // n = 1.5, αR = 0.1: of parallel light that fills the disc 0.158404 is absorbed; a camera that sees in
    // parallel, in a white surround, sees the rest
    RenderOutcome const outcome = render(
        "[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 10}}\nmedium = \"m\"\n"
        "[medium.m]\nn = 1.5\nabsorption_per_mm = 0.01\n[trace]\nmin_power = 1e-7\nmax_depth = 400\n"
        "[camera]\nat_mm = [0, 0, 100]\nlook_at_mm = [0, 0, 0]\nheight_mm = 20\nresolution = [64, 64]\n"
        "samples = 16\n[picture]\nfilter = \"box\"\n" +
        white);
    double missing = 0.0;
    for (FilmPixel const& pixel : outcome.film.pixels)
        missing += 1.0 - outcome.film.mean(pixel).y;
    double const square = static_cast<double>(outcome.film.pixels.size());
    // 65 536 samples, stratified in each pixel: those of the rim, 250 pixels in which a sample is worth up to
    // 0.16, leave 1e-5 of the disc
    CHECK(missing / square / (0.25 * 3.14159265358979) == Approx(0.158404).margin(5e-5));
}

TEST_CASE("paint is lit as Phong has it", "[render]") {
    // seen and lit at 45° from both sides: the mirrored ray goes to the lamp itself
    RenderOutcome const outcome =
        render("[surface.p]\npaint = {ambient = [0.1, 0.2, 0.3], diffuse = [0.5, 0.25, 0.125], specular = "
               "[0.2, 0.2, 0.2], "
               "shininess = 7}\n[[object]]\nname = \"wall\"\nshape = {plane = {}}\nsurface = \"p\"\n"
               "[camera]\nat_mm = [100, 0, 100]\nlook_at_mm = [0, 0, 0]\nheight_mm = 1e-6\nresolution = [1, "
               "1]\nsamples = 1\n"
               "[picture]\nambient = [0.5, 0.5, 0.5]\n"
               "[[light]]\npoint = {at_mm = [-100, 0, 100]}\nintensity = [2, 2, 2]\n"
               "[[light]]\ndirectional = {toward = [0, 0, -1]}\nintensity = [1, 0, 0]\n"
               "[[light]]\nspot = {at_mm = [0, 0, 50], toward = [1, 0, 0], half_angle_deg = 80}\n");
    double const root = std::sqrt(0.5), gloss = 0.2 * std::pow(root, 7.0);
    dvec3 const seen = outcome.film.mean(outcome.film.at(0, 0));
    CHECK(seen.x == Approx(0.05 + 2.0 * (0.5 * root + 0.2) + 0.5 + gloss).epsilon(1e-9));
    CHECK(seen.y == Approx(0.1 + 2.0 * (0.25 * root + 0.2)).epsilon(1e-9));
    CHECK(seen.z == Approx(0.15 + 2.0 * (0.125 * root + 0.2)).epsilon(1e-9));
}

TEST_CASE("a shadow is black, or what glass lets through straight on", "[render]") {
    // a plate of n = 1.5 between the lamp and the floor: (1 − 0.04)² of its light, and e^(−0.5) by absorption
    auto const seen = [](std::string const& shadows, std::string const& more = "") {
        Film const film =
            render("[surface.p]\npaint = {diffuse = [1, 1, 1], ambient = [0.125, 0.125, 0.125]" + more +
                   "}\n[[object]]\nname = \"floor\"\nshape = {plane = {}}\nsurface = \"p\"\n"
                   "[[object]]\nname = \"plate\"\nshape = {box = {size_mm = [20, 20, 5]}}\nmedium = \"m\"\n"
                   "move_mm = [0, 0, 30]\n[medium.m]\nn = 1.5\nabsorption_per_mm = 0.1\n"
                   "[camera]\nat_mm = [100, 0, 100]\nlook_at_mm = [0, 0, 0]\nheight_mm = 1e-6\n"
                   "resolution = [1, 1]\nsamples = 1\n[[light]]\ndirectional = {toward = [0, 0, -1]}\n"
                   "[picture]\nshadows = \"" +
                   shadows + "\"\n" + white)
                .film;
        return film.mean(film.at(0, 0)).y;
    };
    CHECK(seen("glass") == Approx(0.125 + 0.96 * 0.96 * std::exp(-0.5)).epsilon(1e-9));
    CHECK(seen("hard") == 0.125);
    CHECK(seen("hard", ", reflect = 0.5") == Approx(0.625).epsilon(1e-12));
    CHECK(seen("ambient", ", reflect = 0.5") == 0.125);
}

TEST_CASE("one random branch a hit shows the same picture as full trees, on the average", "[render]") {
    std::string const scene =
        "[surface.p]\npaint = {ambient = [0.9, 0.7, 0.4], checker = {size_mm = 7}}\n"
        "[[object]]\nname = \"floor\"\nshape = {plane = {}}\nsurface = \"p\"\nmove_mm = [0, 0, -25]\n"
        "[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 15}}\nmedium = \"m\"\n"
        "[medium.m]\nn = 1.8\nabsorption = [[460, 0.06], [540, 0.02], [610, 0.01]]\n"
        "[camera]\nat_mm = [10, 20, 100]\nlook_at_mm = [0, 0, 0]\nfov_deg = 20\n"
        "resolution = [64, 48]\nsamples = 8\n[background]\ncolor = [0.1, 0.2, 0.5]\n"
        "[picture]\nwavelengths = 1\n[trace]\nmin_power = 1e-7\nmax_depth = 400\n";
    auto const pieces = [](RenderOutcome const& outcome) {
        return std::accumulate(outcome.ended.begin(), outcome.ended.end(), std::uint64_t{0});
    };
    RenderOutcome const whole = render(scene);
    RenderOutcome const drawn = render(scene + "branch = \"roulette\"\nsplit_until = 1\nsplit_depth = 0\n");
    CHECK(pieces(drawn) * 2 < pieces(whole));
    double const count = static_cast<double>(whole.film.pixels.size());
    for (int colour = 0; colour < 3; ++colour) {
        double sum = 0.0, squares = 0.0, most = 0.0; // pixels are drawn independently of each other
        for (std::size_t i = 0; i < whole.film.pixels.size(); ++i) {
            double const off =
                drawn.film.mean(drawn.film.pixels[i])[colour] - whole.film.mean(whole.film.pixels[i])[colour];
            sum += off;
            squares += off * off;
            most = std::max(most, std::abs(off));
        }
        double const error = std::sqrt(squares) / count; // standard, of the mean
        CAPTURE(colour, sum / count, error);
        CHECK(most > 0.1);   // each pixel is noisy
        CHECK(error < 2e-3); // their mean is not
        CHECK(std::abs(sum) / count < 4.0 * error);
    }
}

TEST_CASE("at a depth of 0 rays are cast and go no further", "[render]") {
    std::string const scene =
        "[surface.p]\nreflect = 0.5\n[[object]]\nname = \"mirror\"\nshape = {plane = {}}\n"
        "surface = \"p\"\n" +
        furnace_camera + white;
    CHECK(farthest(render(scene).film, dvec3(0.5)) < 1e-12);
    CHECK(farthest(render(scene + "[trace]\nmax_depth = 0\n").film, dvec3(0.0)) == 0.0);
}

TEST_CASE("adaptive sampling spends its samples where neighbours differ", "[render]") {
    std::string const scene =
        "[surface.p]\npaint = {ambient = [1, 1, 1]}\n[[object]]\nname = \"disk\"\n"
        "shape = {disk = {radius_mm = 10}}\nsurface = \"p\"\n[camera]\nat_mm = [0, 0, 100]\n"
        "look_at_mm = [0, 0, 0]\nheight_mm = 40\nresolution = [40, 40]\nsamples = 16\n"
        "[picture]\nadaptive = 0.1\nfilter = \"box\"\n";
    RenderOutcome const outcome = render(scene);
    CHECK(outcome.film.at(20, 20).samples == 4);
    CHECK(outcome.film.at(1, 1).samples == 4);
    CHECK(outcome.film.at(20, 10).samples == 16);
    CHECK(outcome.film.at(10, 20).samples == 16);
    CHECK(outcome.sampled_again < 200); // of the 1600: the rim is 63 pixels long
}

TEST_CASE("paint that covers a part shows that part of its colour, and lets the rest pass, to lamps too",
          "[render]") {
    std::string const scene =
        "[surface.film]\npaint = {ambient = [0.8, 0.2, 0], covers = 0.25, reflect = 0.5}\n"
        "[surface.white]\npaint = {diffuse = [1, 1, 1]}\n"
        "[[object]]\nname = \"film\"\nshape = {rectangle = {size_mm = [80, 80]}}\nsurface = \"film\"\n"
        "[[object]]\nname = \"wall\"\nshape = {rectangle = {size_mm = [400, 400]}}\nsurface = \"white\"\n"
        "move_mm = [0, 0, -30]\n[[light]]\ndirectional = {toward = [0, 0, -1]}\n"
        "[camera]\nat_mm = [0, 0, 100]\nlook_at_mm = [0, 0, 0]\nheight_mm = 1\nresolution = [4, 4]\n"
        "[background]\ncolor = [0.4, 0.4, 0.4]\n";
    // its own part; the sky in the mirror; and the wall, lit through the film, seen through it
    dvec3 const part = 0.25 * dvec3(0.8, 0.2, 0.0) + dvec3(0.25 * 0.5 * 0.4);
    CHECK(farthest(render(scene).film, part + dvec3(0.75 * 0.75)) < 1e-12);
    CHECK(farthest(render(scene + "[picture]\nshadows = \"hard\"\n").film, part) < 1e-12);
}
