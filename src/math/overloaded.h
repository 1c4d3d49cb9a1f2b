// In: a handful of lambdas. Out: one visitor for std::visit.
#pragma once

namespace sahl {

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

} // namespace sahl
