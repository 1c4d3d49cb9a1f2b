// In: nothing. Out: a vector of bounded size that never allocates.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace sahl {

template <class T, std::size_t Capacity>
class InlineVector {
  public:
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == Capacity; }
    T* begin() { return items_.data(); }
    T* end() { return items_.data() + size_; }
    T const* begin() const { return items_.data(); }
    T const* end() const { return items_.data() + size_; }
    T& operator[](std::size_t i) { return items_[i]; }
    T const& operator[](std::size_t i) const { return items_[i]; }
    T& front() { return items_[0]; }
    T const& front() const { return items_[0]; }
    T& back() { return items_[size_ - 1]; }
    void clear() { size_ = 0; }
    void push_back(T const& item) {
        assert(size_ < Capacity);
        items_[size_++] = item;
    }
    /// The order of the rest is kept.
    void erase(T* where) {
        for (T* next = where + 1; next != end(); ++where, ++next)
            *where = *next;
        --size_;
    }

  private:
    std::array<T, Capacity> items_;
    std::size_t size_ = 0;
};

} // namespace sahl
