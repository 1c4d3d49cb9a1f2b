// In: a scene of the torture suite. Out: Sahl's own ways through it: as it is; and with the bodies asked one
// by one, so that nothing is known of their contacts.
#pragma once

#include "scene/scene.h"
#include "torture/finder.h"

namespace sahl::bench {

/// The scene as Sahl holds it: bodies in the case's order, mediums numbered as there; closed meshes met by
/// their triangles, or as curved surfaces.
Scene sahl_scene(TortureCase const& torture, Curving curving = Curving::none);

std::unique_ptr<Finder> ours(TortureCase const& torture, Curving curving = Curving::none);
std::unique_ptr<Finder> ours_without_contact(TortureCase const& torture);

} // namespace sahl::bench
