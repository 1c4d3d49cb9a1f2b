#include "run/model_marks.h"

#include "geometry/mesh_health_parts.h"
#include "scene/read_model.h"

#include <algorithm>
#include <map>
#include <set>

namespace sahl {

namespace {

constexpr std::size_t most_pieces = 20'000;

/// Places are told by their numbers alone, as a mesh is welded.
using Key = std::array<std::array<double, 3>, 3>;

/// A triangle's corners in order of place, and whether that turned it round.
std::pair<Key, bool> key_of(TriangleSoup const& soup, std::size_t triangle) {
    Key key{};
    for (std::size_t k = 0; k < 3; ++k) {
        dvec3 const p = soup.positions[soup.triangles[triangle][k]] + 0.0; // −0 is 0
        key[k] = {p.x, p.y, p.z};
    }
    bool turned = false;
    for (auto const& [a, b] : {std::pair(0, 1), {1, 2}, {0, 1}})
        if (key[static_cast<std::size_t>(b)] < key[static_cast<std::size_t>(a)]) {
            std::swap(key[static_cast<std::size_t>(a)], key[static_cast<std::size_t>(b)]);
            turned = !turned;
        }
    return {key, turned};
}

class Marker {
  public:
    explicit Marker(Model const& model) {
        for (ModelMesh const& mesh : model.meshes)
            for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
                auto const [key, turned] = key_of(mesh.soup, t);
                (turned ? as_turned_ : as_is_).insert(key);
            }
    }

    void look_at(Body const& body) {
        HealthView const view = view_of(*body.mesh);
        for (std::uint32_t side = 0; side < view.sides.across.size(); ++side)
            if (view.sides.across[side] == Sides::border)
                line(holes_, body, view.at(side), view.at(next_side(side)));
        for (std::uint32_t const side : view.sides.crowded_edges)
            line(crowded_, body, view.at(side), view.at(next_side(side)));
        TriangleSoup const& soup = body.mesh->soup;
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            std::array<dvec3, 3> const corners{soup.positions[soup.triangles[t][0]],
                                               soup.positions[soup.triangles[t][1]],
                                               soup.positions[soup.triangles[t][2]]};
            if (is_sliver(corners))
                triangle(slivers_, body, corners);
            if (body.mesh->flipped_triangles > 0 && was_turned(soup, t))
                triangle(turned_, body, corners);
        }
    }

    std::vector<PageMark> marks() {
        std::vector<PageMark> all;
        add(all, holes_, "holes", "edges where the surface ends: a hole, or the rim of a sheet");
        add(all, turned_, "turned", "triangles that lay the other way round; they are traced turned");
        add(all, slivers_, "slivers", "slivers: triangles thinner than 0.01 of their longest side");
        add(all, crowded_, "crowded",
            "edges that more than two triangles share, or two that face against each other");
        return all;
    }

  private:
    struct Found {
        std::vector<float> places;
        std::size_t count = 0;
    };

    static void put(Found& found, Body const& body, dvec3 const& place) {
        dvec3 const p = 1e3 * body.to_world.point(place);
        for (int axis = 0; axis < 3; ++axis)
            found.places.push_back(static_cast<float>(p[axis]));
    }
    static void line(Found& found, Body const& body, dvec3 const& a, dvec3 const& b) {
        if (++found.count > most_pieces)
            return;
        put(found, body, a);
        put(found, body, b);
    }
    static void triangle(Found& found, Body const& body, std::array<dvec3, 3> const& corners) {
        if (++found.count > most_pieces)
            return;
        for (dvec3 const& corner : corners)
            put(found, body, corner);
    }
    static bool is_sliver(std::array<dvec3, 3> const& c) {
        double const longest = std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
        double const area = length(cross(c[1] - c[0], c[2] - c[0])); // twice
        return area < MeshHealth::sliver_ratio * longest * longest;
    }
    /// It stands in the file the other way round, and not as it is.
    bool was_turned(TriangleSoup const& soup, std::size_t t) const {
        auto const [key, turned] = key_of(soup, t);
        return (turned ? as_is_ : as_turned_).contains(key) && !(turned ? as_turned_ : as_is_).contains(key);
    }
    static void add(std::vector<PageMark>& all, Found const& found, char const* kind,
                    std::string const& what) {
        if (found.count == 0)
            return;
        std::string text = what + ": " + std::to_string(found.count);
        if (found.count > most_pieces)
            text += " (the first " + std::to_string(most_pieces) + " are drawn)";
        bool const lines = std::string_view(kind) == "holes" || std::string_view(kind) == "crowded";
        all.push_back({kind, text, lines ? found.places : std::vector<float>(),
                       lines ? std::vector<float>() : found.places});
    }

    std::set<Key> as_is_, as_turned_; // the file's triangles, by the way round that their order of places is
    Found holes_, turned_, slivers_, crowded_;
};

} // namespace

std::vector<PageMark> model_marks(std::filesystem::path const& file, Scene const& scene) {
    Marker marker(read_model(file));
    std::set<Mesh const*> seen; // of instances the first
    for (Body const& body : scene.bodies)
        if (body.mesh && seen.insert(body.mesh.get()).second)
            marker.look_at(body);
    return marker.marks();
}

} // namespace sahl
