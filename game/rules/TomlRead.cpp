#include "game/rules/TomlRead.h"

#include <fmt/core.h>

namespace shoal::game {

void TomlMistake::complain(const toml::node* where, std::string reason) {
    if (first) return;
    const auto line = where ? where->source().begin.line : 0;
    first = Error{file.string(), line ? "line " + std::to_string(line) + ": " + reason : reason};
}

Status readToml(const Path& file, const TomlTable::Read& read) {
    const auto text = readText(file, 1u << 20);
    if (!text) return text.error();
    TomlMistake mistake{file, {}};
    try {
        const toml::table root = toml::parse(*text, file.string());
        TomlTable table(mistake, root);
        read(table);
        table.finish();
    } catch (const toml::parse_error& error) {
        mistake.complain(nullptr, "line " + std::to_string(error.source().begin.line) + ": " +
                                      std::string(error.description()));
    }
    if (mistake.first) return *mistake.first;
    return Done{};
}

const toml::node* TomlTable::at(std::string_view key) {
    read_.emplace(key);
    return table_.get(key);
}

void TomlTable::complain(std::string_view key, std::string reason) {
    const toml::node* node = table_.get(key);
    mistake_.complain(node ? node : &table_, "\"" + std::string(key) + "\" " + reason);
}

void TomlTable::need(std::string_view key) {
    if (!has(key)) complain(key, "is missing");
}

void TomlTable::number(std::string_view key, float& value, float low, float high) {
    const toml::node* node = at(key);
    if (!node) return;
    const auto read = node->value<double>();
    if (!node->is_number() || !read || !(*read >= low && *read <= high))
        complain(key, fmt::format("must be a number from {} to {}", low, high));
    else
        value = static_cast<float>(*read);
}

std::optional<int64_t> TomlTable::readWhole(std::string_view key, int64_t low, int64_t high) {
    const toml::node* node = at(key);
    if (!node) return std::nullopt;
    const auto read = node->is_integer() ? node->value<int64_t>() : std::nullopt;
    if (read && *read >= low && *read <= high) return read;
    complain(key, fmt::format("must be a whole number from {} to {}", low, high));
    return std::nullopt;
}

void TomlTable::flag(std::string_view key, bool& value) {
    const toml::node* node = at(key);
    if (!node) return;
    if (const auto* read = node->as_boolean())
        value = read->get();
    else
        complain(key, "must be true or false");
}

void TomlTable::text(std::string_view key, std::string& value) {
    const toml::node* node = at(key);
    if (!node) return;
    if (const auto* read = node->as_string())
        value = read->get();
    else
        complain(key, "must be a string");
}

std::optional<size_t> TomlTable::choice(std::string_view key, std::span<const char* const> names) {
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
    const toml::node* node = at(key);
    if (!node) return;
    const auto* pair = node->as_array();
    const auto a = pair && pair->size() == 2 ? (*pair)[0].value<double>() : std::nullopt;
    const auto b = pair && pair->size() == 2 ? (*pair)[1].value<double>() : std::nullopt;
    if (!a || !b || !(*a >= low && *a <= *b && *b <= high)) {
        complain(key, fmt::format("must be [low, high] within {} to {}", low, high));
        return;
    }
    first = static_cast<float>(*a);
    second = static_cast<float>(*b);
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
    TomlTable inner(mistake_, *node->as_table());
    read(inner);
    inner.finish();
}

void TomlTable::tables(std::string_view key, size_t maximum, const Read& read) {
    const toml::array* all = list(key);
    if (!all) return;
    if (all->size() > maximum) return complain(key, fmt::format("holds more than {} tables", maximum));
    for (const toml::node& node : *all) {
        if (!node.is_table()) {
            const std::string name(key);
            return mistake_.complain(&node, "each " + name + " must be a table [[" + name + "]]");
        }
        TomlTable inner(mistake_, *node.as_table());
        read(inner);
        inner.finish();
    }
}

void TomlTable::finish() {
    for (const auto& [key, node] : table_)
        if (!read_.contains(key.str()))
            mistake_.complain(&node, "unknown key \"" + std::string(key.str()) + "\"");
}

} // namespace shoal::game
