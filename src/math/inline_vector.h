// In: nothing. Out: a vector of bounded size that never allocates.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

namespace sahl {

/// A large one writes and copies only the items that it holds; a small one is copied whole, which is quicker
/// than a loop.
template <class T, std::size_t Capacity>
class InlineVector {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    static constexpr bool small = sizeof(T) * Capacity <= 64; // a cache line, with the size

  public:
    InlineVector() noexcept {
        if constexpr (small)
            std::memset(static_cast<void*>(items_), 0, sizeof items_);
    }
    InlineVector(InlineVector const& other) noexcept requires small = default;
    InlineVector(InlineVector const& other) noexcept { copy(other); }
    InlineVector& operator=(InlineVector const& other) noexcept requires small = default;
    InlineVector& operator=(InlineVector const& other) noexcept {
        if (this != &other)
            copy(other);
        return *this;
    }
    ~InlineVector() = default;

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == Capacity; }
    T* begin() { return items_; }
    T* end() { return items_ + size_; }
    T const* begin() const { return items_; }
    T const* end() const { return items_ + size_; }
    T& operator[](std::size_t i) { return items_[i]; }
    T const& operator[](std::size_t i) const { return items_[i]; }
    T& front() { return items_[0]; }
    T const& front() const { return items_[0]; }
    T& back() { return items_[size_ - 1]; }
    void clear() { size_ = 0; }
    void push_back(T const& item) {
        assert(size_ < Capacity);
        ::new (static_cast<void*>(items_ + size_++)) T(item);
    }
    /// One more, as its default constructor leaves it.
    T& emplace_back() {
        assert(size_ < Capacity);
        return *::new (static_cast<void*>(items_ + size_++)) T;
    }
    /// Before the first item that `less` puts behind it: keeps an ordered vector ordered.
    template <class Less>
    void insert_sorted(T const& item, Less&& less) {
        push_back(item);
        for (T* at = end() - 1; at != begin() && less(item, *(at - 1)); --at) {
            *at = *(at - 1);
            *(at - 1) = item;
        }
    }
    /// The order of the rest is kept.
    void erase(T* where) {
        std::copy(where + 1, end(), where);
        --size_;
    }

  private:
    void copy(InlineVector const& other) {
        size_ = other.size_;
        std::memcpy(static_cast<void*>(items_), other.items_, size_ * sizeof(T));
    }

    union {
        T items_[Capacity];
    };
    std::uint32_t size_ = 0;
};

} // namespace sahl
