#include "game/rules/TomlRead.h"

#include "engine/core/Number.h"

#include <fmt/core.h>

namespace shoal::game {

void TomlMistake::complain(const toml::source_region& where, std::string_view reason) {
    if (first) return;
    const auto line = where.begin.line;
    first = Error{file.string(), line ? fmt::format("line {}: {}", line, reason) : std::string(reason)};
}

Status readToml(const Path& file, const TomlTable::Read& read) {
    const auto text = readText(file, 1u << 20);
    if (!text) return text.error();
    TomlMistake mistake{file, {}};
    try {
        const toml::table root = toml::parse(*text, file.string());
        TomlTable(mistake, root).readTable(root, read);
    } catch (const toml::parse_error& error) {
        mistake.complain(error.source(), error.description());
    }
    if (mistake.first) return *mistake.first;
    return Done{};
}

std::optional<float> numberIn(const toml::node& node, float low, float high) {
    const auto number = node.value<float>();
    return number && isWithin(*number, low, high) ? number : std::nullopt;
}

const toml::node* TomlTable::at(std::string_view key) {
    read_.emplace(key);
    return table_.get(key);
}

void TomlTable::complain(std::string_view key, std::string_view reason) {
    const toml::node* node = table_.get(key);
    mistake_.complain((node ? node : &table_)->source(), fmt::format("\"{}\" {}", key, reason));
}

template <class T, class Good>
std::optional<T> TomlTable::read(std::string_view key, const std::string& mustBe, const Good& good) {
    const toml::node* node = at(key);
    if (!node) return std::nullopt;
    if (const auto value = node->value_exact<T>(); value && good(*value)) return value;
    complain(key, mustBe);
    return std::nullopt;
}

void TomlTable::number(std::string_view key, float& value, float low, float high) {
    const toml::node* node = at(key);
    const auto number = node ? numberIn(*node, low, high) : value;
    if (!number) return complain(key, fmt::format("must be a number from {} to {}", low, high));
    value = *number;
}

std::optional<int64_t> TomlTable::readWhole(std::string_view key, int64_t low, int64_t high) {
    return read<int64_t>(key, fmt::format("must be a whole number from {} to {}", low, high),
                         [&](int64_t v) { return isWithin(v, low, high); });
}

void TomlTable::flag(std::string_view key, bool& value) {
    value = read<bool>(key, "must be true or false", [](bool) { return true; }).value_or(value);
}

void TomlTable::text(std::string_view key, std::string& value) {
    value = read<std::string>(key, "must be a string", [](const auto&) { return true; }).value_or(value);
}

std::optional<size_t> TomlTable::readChoice(std::string_view key, std::span<const char* const> names) {
    if (!has(key)) return std::nullopt;
    std::string given, listed;
    text(key, given);
    for (size_t i = 0; i < names.size(); ++i) {
        if (given == names[i]) return i;
        listed += (i == 0 ? "" : ", ") + std::string(names[i]);
    }
    complain(key, "must be one of " + listed);
    return std::nullopt;
}

void TomlTable::range(std::string_view key, float& first, float& second, float low, float high) {
    const toml::array* pair = list(key);
    if (!pair) return;
    const auto a = pair->size() == 2 ? numberIn((*pair)[0], low, high) : std::nullopt;
    const auto b = a ? numberIn((*pair)[1], *a, high) : std::nullopt;
    if (!b) return complain(key, fmt::format("must be [low, high] within {} to {}", low, high));
    first = *a;
    second = *b;
}

void TomlTable::place(std::string_view key, glm::vec3& value, float limit) {
    const toml::array* all = list(key);
    for (size_t k = 0; all && k < 3; ++k) {
        const auto at = all->size() == 3 ? numberIn((*all)[k], -limit, limit) : std::nullopt;
        if (!at) return complain(key, fmt::format("must be [x, y, z] within -{0} to {0}", limit));
        value[static_cast<int>(k)] = *at;
    }
}

const toml::array* TomlTable::list(std::string_view key) {
    const toml::node* node = at(key);
    if (!node) return nullptr;
    if (!node->is_array()) complain(key, "must be a list");
    return node->as_array();
}

void TomlTable::table(std::string_view key, const Read& read) {
    const toml::node* node = at(key);
    if (!node) return;
    if (!node->is_table()) return complain(key, "must be a table");
    readTable(*node, read);
}

void TomlTable::tables(std::string_view key, size_t maximum, const Read& read) {
    const toml::array* all = list(key);
    if (!all) return;
    if (all->size() > maximum) return complain(key, fmt::format("holds more than {} tables", maximum));
    for (const toml::node& node : *all) {
        if (!node.is_table())
            return mistake_.complain(node.source(), fmt::format("each {0} must be a table [[{0}]]", key));
        readTable(node, read);
    }
}

// Reads a table, and complains about keys that nothing has read.
void TomlTable::readTable(const toml::node& node, const Read& read) {
    TomlTable inner(mistake_, *node.as_table());
    read(inner);
    for (const auto& [key, value] : inner.table_)
        if (!inner.read_.contains(key.str()))
            mistake_.complain(value.source(), fmt::format("unknown key \"{}\"", key.str()));
}

} // namespace shoal::game
