// Strict reader of the game's small TOML files: an unknown key, or a value of a wrong type or out of its
// range, is an error that names the line.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <glm/vec3.hpp>
#include <toml++/toml.h>

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace shoal::game {

// Returns the node's number; empty if the node holds no number, or one out of the range.
std::optional<float> numberIn(const toml::node& node, float low, float high);

// One table of the file. Optional keys keep the default. The first mistake ends the reading: it is thrown as
// an Error, which readToml() returns.
class TomlTable {
  public:
    using Read = std::function<void(TomlTable&)>;

    // Reads a table, and complains about keys that `read` has not read.
    static void readTable(const toml::table& table, const Read& read);

    bool has(std::string_view key) const { return table_.contains(key); }
    int line() const { return static_cast<int>(table_.source().begin.line); }

    void number(std::string_view key, float& value, float low, float high);
    template <class Integer> void whole(std::string_view key, Integer& value, int64_t low, int64_t high) {
        if (const auto read = readWhole(key, low, high)) value = static_cast<Integer>(*read);
    }
    void flag(std::string_view key, bool& value);
    void text(std::string_view key, std::string& value);
    // Reads a list of texts, at most values.size() of them.
    void texts(std::string_view key, std::span<std::string> values);
    // Reads a string that must be one of the names; value: its index among them.
    template <class E> void choice(std::string_view key, std::span<const char* const> names, E& value) {
        if (const auto index = readChoice(key, names)) value = static_cast<E>(*index);
    }
    template <class E>
    void choice(std::string_view key, std::span<const char* const> names, std::optional<E>& value) {
        if (has(key)) choice(key, names, value.emplace());
    }
    // Reads [first, second], where low <= first <= second <= high.
    void range(std::string_view key, float& first, float& second, float low, float high);
    // Reads [x, y, z], each from low to high.
    void triple(std::string_view key, glm::vec3& value, float low, float high);
    const toml::array* list(std::string_view key);
    // Calls read for the table [key], or for each of at most `maximum` tables [[key]].
    void table(std::string_view key, const Read& read);
    void tables(std::string_view key, size_t maximum, const Read& read);

    template <class... Key> void need(Key... keys) const {
        for (const std::string_view key : {std::string_view(keys)...})
            if (!has(key)) complain(key, "is missing");
    }
    [[noreturn]] void complain(std::string_view key, std::string_view reason) const;

  private:
    explicit TomlTable(const toml::table& table) : table_(table) {}
    const toml::node* at(std::string_view key);
    // Returns the key's value; empty if it is missing. mustBe: the complaint about a value of another type.
    template <class T> std::optional<T> read(std::string_view key, std::string_view mustBe);
    std::optional<int64_t> readWhole(std::string_view key, int64_t low, int64_t high);
    std::optional<size_t> readChoice(std::string_view key, std::span<const char* const> names);

    const toml::table& table_;
    std::set<std::string, std::less<>> read_; // keys read so far
};

// Reads a file: calls read with its root table.
Status readToml(const Path& file, const TomlTable::Read& read);

} // namespace shoal::game
