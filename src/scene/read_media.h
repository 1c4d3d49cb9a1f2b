// In: the tables [medium.NAME] and names asked for. Out: the media that something refers to, each once.
#pragma once

#include "materials/catalogue.h"
#include "materials/medium.h"
#include "math/ids.h"
#include "scene/value.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sahl {

/// Gives out ids for names of media, so that only what is referred to reaches the experiment.
class MediaBook {
  public:
    /// `definitions`: the table `medium`, or nullptr; `own`: the glasses of the user's catalogues. Throws
    /// InputError at the first that is wrong, referred to or not.
    explicit MediaBook(Value const* definitions, std::vector<GlassEntry> own = {});

    /// A name defined in the file goes before one of the user's catalogues, and that before one of the
    /// built-in catalogue. Throws InputError with names that are near, or with the makers where they share
    /// the name.
    MediumId refer(std::string_view name, Place const& place);

    /// What has been referred to, by id, and where it is defined, or first asked for if it is in the
    /// catalogue.
    std::vector<Medium> const& media() const { return media_; }
    std::vector<Place> const& places() const { return places_; }

  private:
    struct Entry {
        Medium medium;
        Place place;
        std::string catalogue_name; // full; empty: defined in the file
        int id = -1;                // not referred to
    };
    MediumId give(Entry& entry);
    [[noreturn]] void refuse(std::string_view name, Place const& place) const;

    std::vector<GlassEntry> own_;
    std::vector<Entry> defined_, from_catalogue_;
    std::vector<Medium> media_;
    std::vector<Place> places_;
};

/// That something is used at wavelengths outside of a range, each in m; nothing where it is not, or where the
/// range is {0, 0}.
std::optional<std::string> range_warning(std::string const& what, std::pair<double, double> range,
                                         std::vector<double> const& wavelengths);

/// What is wrong with the media at these wavelengths (m, ascending): throws InputError where an index is not
/// a number above 0, returns a warning for each medium that is used outside its formula's range.
std::vector<std::string> check_media(MediaBook const& book, std::vector<double> const& wavelengths);

} // namespace sahl
