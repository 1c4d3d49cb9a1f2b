// In: nothing. Out: how somebody looks on while trees grow, and weighs their branches by colour: a picture.
#pragma once

#include "scene/interface.h"
#include "trace/branch.h"
#include "trace/sources.h"

#include <span>

namespace sahl {

/// Looks on as the trees of a group of rays grow, generation by generation. Branches have numbers, from 0 in
/// each generation, in the order in which they were pushed.
class TreeWatch {
  public:
    /// A group of rays begins: the branches of generation 0, ray by ray.
    virtual void plant(std::span<Branch const> roots, std::span<Ray const> rays) = 0;
    /// Branch `number` meets a surface. Branches may be changed here: shares, or none at all.
    ///   branches   not yet chosen from
    /// Returns the power that arrives (W), from which the outgoing ones get theirs.
    virtual double meet(std::size_t number, Branch const& branch, Interface const& interface,
                        Branches& branches) = 0;
    /// Branch `number` ends without a surface: event is escaped, cut_power, cut_depth, leak or invalid.
    virtual void lose(std::size_t number, Branch const& branch, Event event) = 0;
    /// A child of a branch of ray `ray` of the group ends where it begins: it has too little power (W), or is
    /// too deep.
    virtual void cut(std::uint32_t ray, double power) = 0;
    /// A child of branch `number` takes the next number of the next generation.
    virtual void push(std::size_t number, Branch const& child, Outgoing const& outgoing) = 0;
    /// The next generation becomes this one.
    virtual void next_generation() = 0;

  protected:
    ~TreeWatch() = default;
};

} // namespace sahl
