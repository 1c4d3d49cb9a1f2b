// What a page shows of a detector is the same from memory and from the files of the run.
#include "run/detector_files.h"
#include "run/page_detectors.h"
#include "support/bench.h"
#include "support/catch.h"

using namespace sahl;

TEST_CASE("a detector's picture, spot, far field and optical paths are read again from its files") {
    DetectorSpec spec;
    spec.name = "left/right";
    spec.size = {0.004, 0.002};
    spec.columns = 8;
    spec.rows = 4;
    spec.spot = true;
    spec.path_bins = 5;
    spec.far_field = FarField{{0, 0, 1}, {0, 1, 0}, 3, 4, 1.5};
    DetectorRecord record(spec, SumUnit::for_total(1.0), 1, 1);
    for (std::uint64_t ray = 0; ray < 40; ++ray) {
        DetectorHit hit;
        hit.ray = ray;
        double const t = static_cast<double>(ray) / 40.0;
        hit.at = {0.0038 * (t - 0.5), 0.0019 * (0.5 - t * t)};
        hit.direction = normalize(dvec3(t, 0.3 - t, 1.0));
        hit.power = 0.01 + 0.001 * t;
        hit.optical_path = 0.1 + t;
        record.add(hit);
    }
    bench::Folder const folder;
    write_detector_files(record, folder.path(), "title", {500e-9});
    std::vector<DetectorRecord> const records{record};
    PageDetector const kept = page_detectors(records)[0], read = page_detectors({spec}, folder.path())[0];
    CHECK(kept.name == "left/right");
    CHECK(kept.irradiance.size() == 32);
    CHECK(read.irradiance == kept.irradiance);
    CHECK(read.columns == kept.columns);
    CHECK(read.encircled_mm == kept.encircled_mm);
    CHECK(kept.encircled_mm.size() == 100);
    CHECK(read.far_field.intensities == kept.far_field.intensities);
    CHECK(kept.far_field.intensities.size() == 12);
    CHECK(read.optical_path.powers == kept.optical_path.powers);
    CHECK(read.optical_path.from_mm == Approx(kept.optical_path.from_mm).epsilon(1e-14));
    CHECK(page_detectors({spec}, folder.path() / "nowhere")[0].irradiance.empty());
}

TEST_CASE("a picture with more pixels than a page shows keeps its light") {
    DetectorSpec spec;
    spec.name = "wide";
    spec.size = {0.01, 0.01};
    spec.columns = spec.rows = 900;
    DetectorRecord record(spec, SumUnit::for_total(1.0), 1, 1);
    for (std::uint64_t ray = 0; ray < 500; ++ray) {
        DetectorHit hit;
        hit.ray = ray;
        hit.at = {0.0099 * (static_cast<double>(ray % 25) / 25.0 - 0.49),
                  0.0099 * (static_cast<double>(ray / 25) / 20.0 - 0.48)};
        hit.power = 1e-4;
        record.add(hit);
    }
    PageDetector const page = page_detectors(std::vector<DetectorRecord>{record})[0];
    CHECK(page.pixels_in_one == 2);
    CHECK(page.columns == 450);
    double power = 0.0;
    for (float const irradiance : page.irradiance)
        power += static_cast<double>(irradiance) * (10.0 / 450) * (10.0 / 450);
    CHECK(power == Approx(0.05).epsilon(1e-5)); // of floats
}
