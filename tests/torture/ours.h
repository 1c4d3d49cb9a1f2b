// In: a scene of the torture suite. Out: Sahl's own ways through it: as it is; and with the bodies asked one
// by one, so that nothing is known of their contacts.
#pragma once

#include "scene/scene.h"
#include "torture/finder.h"

namespace sahl::bench {

/// The scene as Sahl holds it: bodies in the case's order, mediums numbered as there; closed meshes met by
/// their triangles, or as curved surfaces.
Scene sahl_scene(TortureCase const& torture, Curving curving = Curving::none);

std::unique_ptr<Finder> ours(TortureCase const& torture);
/// The same, its closed meshes met as curved surfaces.
std::unique_ptr<Finder> ours_curved(TortureCase const& torture, Curving curving);
/// Has it closed meshes that refract, and are the curved surfaces of all of them the triangles themselves, so
/// that its judge has the truth for `ours_curved` too?
bool is_flat_faced(TortureCase const& torture);
/// The same, each ray asked about in a packet with others.
std::unique_ptr<Finder> ours_in_packets(TortureCase const& torture);
/// The same, each ray asked about ahead with others, one after another.
std::unique_ptr<Finder> ours_in_turn(TortureCase const& torture);
std::unique_ptr<Finder> ours_without_contact(TortureCase const& torture);

} // namespace sahl::bench
