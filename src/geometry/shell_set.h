// In: nothing. Out: the set of shells that a place lies in, which every ray carries.
#pragma once

#include "math/ids.h"
#include "math/inline_vector.h"

namespace sahl {

/// At most `capacity` shells round one place: deeper nesting is reported as an invalid ray, never guessed.
class ShellSet {
  public:
    static constexpr std::size_t capacity = 15;

    bool contains(ShellId shell) const { // mostly of none or one: std::find begins by counting in fours
        for (ShellId const each : shells_)
            if (each == shell)
                return true;
        return false;
    }
    bool empty() const { return shells_.empty(); }
    /// False where the set is full.
    bool insert(ShellId shell) {
        if (shells_.full())
            return false;
        shells_.push_back(shell);
        return true;
    }
    void erase(ShellId shell) {
        for (ShellId& each : shells_)
            if (each == shell)
                return shells_.erase(&each);
    }
    auto begin() const { return shells_.begin(); }
    auto end() const { return shells_.end(); }

  private:
    InlineVector<ShellId, capacity> shells_;
};

} // namespace sahl
