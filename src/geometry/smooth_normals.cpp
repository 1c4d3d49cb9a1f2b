#include "geometry/smooth_normals.h"

#include "geometry/smooth_fans.h"

#include <algorithm>

namespace sahl {

std::shared_ptr<Mesh const> with_smooth_normals(std::shared_ptr<Mesh const> mesh) {
    if (!mesh->soup.normals.empty())
        return mesh;
    SmoothFans const fans = smooth_fans(mesh);
    auto smooth = std::make_shared<Mesh>(*mesh);
    TriangleSoup& soup = smooth->soup;
    soup.positions.clear();
    for (Fan const& fan : fans.fans) {
        soup.positions.push_back(fan.place);
        soup.normals.push_back(fan.normal);
    }
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        auto const& of_triangle = fans.triangles[t].fans; // of a cavity, they run the other way round
        for (std::uint32_t& corner : soup.triangles[t])
            corner = *std::find_if(of_triangle.begin(), of_triangle.end() - 1, [&](std::uint32_t fan) {
                return fans.fans[fan].place == mesh->soup.positions[corner];
            });
    }
    return smooth;
}

} // namespace sahl
