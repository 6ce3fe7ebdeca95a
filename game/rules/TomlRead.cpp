#include "game/rules/TomlRead.h"

#include "engine/core/Number.h"

#include <fmt/format.h>

#include <algorithm>

namespace shoal::game {

[[noreturn]] static void fail(const toml::source_region& where, std::string_view reason) {
    throw Error{"", where.begin.line ? fmt::format("line {}: {}", where.begin.line, reason)
                                     : std::string(reason)};
}

Status readToml(const Path& file, const TomlTable::Read& read) {
    const auto text = readText(file, 1u << 20);
    if (!text) return text.error();
    try {
        TomlTable::readTable(toml::parse(*text, file.string()), read);
    } catch (const toml::parse_error& error) {
        return Error{file.string(),
                     fmt::format("line {}: {}", error.source().begin.line, error.description())};
    } catch (const Error& mistake) {
        return Error{file.string(), mistake.reason};
    }
    return Done{};
}

std::optional<float> numberIn(const toml::node& node, float low, float high) {
    const auto number = node.value<float>();
    return number && isWithin(*number, low, high) ? number : std::nullopt;
}

void TomlTable::readTable(const toml::table& table, const Read& read) {
    TomlTable inner(table);
    read(inner);
    for (const auto& [key, value] : table)
        if (!inner.read_.contains(key.str()))
            fail(value.source(), fmt::format("unknown key \"{}\"", key.str()));
}

const toml::node* TomlTable::at(std::string_view key) {
    read_.emplace(key);
    return table_.get(key);
}

void TomlTable::complain(std::string_view key, std::string_view reason) const {
    const toml::node* node = table_.get(key);
    fail((node ? node : &table_)->source(), fmt::format("\"{}\" {}", key, reason));
}

template <class T> std::optional<T> TomlTable::read(std::string_view key, std::string_view mustBe) {
    const toml::node* node = at(key);
    if (!node) return std::nullopt;
    const std::optional<T> value = node->value_exact<T>();
    if (!value) complain(key, mustBe);
    return value;
}

void TomlTable::number(std::string_view key, float& value, float low, float high) {
    const toml::node* node = at(key);
    const auto number = node ? numberIn(*node, low, high) : value;
    if (!number) complain(key, fmt::format("must be a number from {} to {}", low, high));
    value = *number;
}

std::optional<int64_t> TomlTable::readWhole(std::string_view key, int64_t low, int64_t high) {
    const std::string mustBe = fmt::format("must be a whole number from {} to {}", low, high);
    const auto value = read<int64_t>(key, mustBe);
    if (value && !isWithin(*value, low, high)) complain(key, mustBe);
    return value;
}

void TomlTable::flag(std::string_view key, bool& value) {
    value = read<bool>(key, "must be true or false").value_or(value);
}

void TomlTable::text(std::string_view key, std::string& value) {
    value = read<std::string>(key, "must be a string").value_or(value);
}

std::optional<size_t> TomlTable::readChoice(std::string_view key, std::span<const char* const> names) {
    const auto given = read<std::string>(key, "must be a string");
    if (!given) return std::nullopt;
    const auto found = std::ranges::find(names, *given);
    if (found == names.end()) complain(key, fmt::format("must be one of {}", fmt::join(names, ", ")));
    return static_cast<size_t>(found - names.begin());
}

void TomlTable::range(std::string_view key, float& first, float& second, float low, float high) {
    const toml::array* pair = list(key);
    if (!pair) return;
    const auto a = pair->size() == 2 ? numberIn((*pair)[0], low, high) : std::nullopt;
    const auto b = a ? numberIn((*pair)[1], *a, high) : std::nullopt;
    if (!b) complain(key, fmt::format("must be [low, high] within {} to {}", low, high));
    first = *a;
    second = *b;
}

void TomlTable::triple(std::string_view key, glm::vec3& value, float low, float high) {
    const toml::array* all = list(key);
    for (size_t k = 0; all && k < 3; ++k) {
        const auto at = all->size() == 3 ? numberIn((*all)[k], low, high) : std::nullopt;
        if (!at) complain(key, fmt::format("must be three numbers from {} to {}", low, high));
        value[static_cast<int>(k)] = *at;
    }
}

void TomlTable::texts(std::string_view key, std::span<std::string> values) {
    const toml::array* all = list(key);
    for (size_t k = 0; all && k < all->size(); ++k) {
        const auto text = (*all)[k].value<std::string>();
        if (!text || k >= values.size())
            complain(key, fmt::format("must be at most {} texts", values.size()));
        values[k] = *text;
    }
}

const toml::array* TomlTable::list(std::string_view key) {
    const toml::node* node = at(key);
    if (node && !node->is_array()) complain(key, "must be a list");
    return node ? node->as_array() : nullptr;
}

void TomlTable::table(std::string_view key, const Read& read) {
    const toml::node* node = at(key);
    if (!node) return;
    if (!node->is_table()) complain(key, "must be a table");
    readTable(*node->as_table(), read);
}

void TomlTable::tables(std::string_view key, size_t maximum, const Read& read) {
    const toml::array* all = list(key);
    if (!all) return;
    if (all->size() > maximum) complain(key, fmt::format("holds more than {} tables", maximum));
    for (const toml::node& node : *all) {
        if (!node.is_table()) fail(node.source(), fmt::format("each {0} must be a table [[{0}]]", key));
        readTable(*node.as_table(), read);
    }
}

} // namespace shoal::game
