// In: numbers and lists of them. Out: their bytes, and the same numbers again: what a run needs to go on
// where it was stopped, by the same program on the same kind of machine.
#pragma once

#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sahl {

/// A type says what it keeps by `template <class Archive> void archive(Archive& all) { all(a, b, c); }`,
/// which serves both ways.
template <class T, class Archive>
concept Archived = requires(T& value, Archive& all) {
    value.archive(all);
};

class ArchiveWriter {
  public:
    template <class... Ts>
    void operator()(Ts&... values) {
        (put(values), ...);
    }
    std::string const& bytes() const { return bytes_; }

  private:
    template <class T>
    void put(T& value) {
        if constexpr (Archived<T, ArchiveWriter>) {
            value.archive(*this);
        } else {
            static_assert(std::is_trivially_copyable_v<T>);
            bytes_.append(reinterpret_cast<char const*>(&value), sizeof value);
        }
    }
    template <class A, class B>
    void put(std::pair<A, B>& pair) {
        put(pair.first);
        put(pair.second);
    }
    template <class T>
    void put(std::optional<T>& value) {
        bool there = value.has_value();
        put(there);
        if (there)
            put(*value);
    }
    template <class T>
    void put(std::vector<T>& list) {
        std::size_t size = list.size();
        put(size);
        if constexpr (std::is_trivially_copyable_v<T> && !Archived<T, ArchiveWriter>)
            bytes_.append(reinterpret_cast<char const*>(list.data()), size * sizeof(T));
        else
            for (T& value : list)
                put(value);
    }

    std::string bytes_;
};

/// Throws std::length_error where the bytes end too early: they are of another kind of run.
class ArchiveReader {
  public:
    explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}
    template <class... Ts>
    void operator()(Ts&... values) {
        (get(values), ...);
    }
    bool at_end() const { return rest_.empty(); }

  private:
    std::string_view take(std::size_t count) {
        if (count > rest_.size())
            throw std::length_error("an archive ends too early");
        std::string_view const taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    template <class T>
    void get(T& value) {
        if constexpr (Archived<T, ArchiveReader>)
            value.archive(*this);
        else
            std::memcpy(&value, take(sizeof value).data(), sizeof value);
    }
    template <class A, class B>
    void get(std::pair<A, B>& pair) {
        get(pair.first);
        get(pair.second);
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool there = false;
        get(there);
        if (!there)
            value.reset();
        else
            get(value.emplace());
    }
    template <class T>
    void get(std::vector<T>& list) {
        std::size_t size = 0;
        get(size);
        if (size > rest_.size()) // each takes a byte at least
            throw std::length_error("an archive ends too early");
        list.resize(size);
        for (T& value : list)
            get(value);
    }

    std::string_view rest_;
};

} // namespace sahl
