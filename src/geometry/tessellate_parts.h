// In: corners and triangles of one face after another. Out: a soup. Shared by the files that tessellate.
#pragma once

#include "geometry/tessellate.h"

namespace sahl {

class SoupBuilder {
  public:
    explicit SoupBuilder(Shape const& shape) {
        for (std::string_view const name : face_names(shape))
            soup_.face_names.emplace_back(name);
    }

    void begin_face(std::uint32_t face) { face_ = face; }

    std::uint32_t corner(dvec3 const& place, dvec3 const& normal) {
        soup_.positions.push_back(place);
        soup_.normals.push_back(normal);
        return static_cast<std::uint32_t>(soup_.positions.size() - 1);
    }

    /// Counterclockwise seen from outside. One whose corners floats cannot tell apart is left out: its
    /// neighbours close over it.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (same(a, b) || same(b, c) || same(c, a))
            return;
        soup_.triangles.push_back({a, b, c});
        soup_.triangle_face.push_back(face_);
    }

    TriangleSoup take() { return std::move(soup_); }

  private:
    bool same(std::uint32_t a, std::uint32_t b) const {
        return glm::vec3(soup_.positions[a]) == glm::vec3(soup_.positions[b]);
    }

    TriangleSoup soup_;
    std::uint32_t face_ = 0;
};

Tessellation tessellate_quadric(QuadricBody const& body, unsigned cells);

} // namespace sahl
