#include "game/rules/TomlRead.h"

#include <cmath>

namespace shoal::game {

namespace {
std::string compact(float value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}
} // namespace

Result<TomlFile> TomlFile::open(const Path& path) {
    auto text = readText(path, 1u << 20);
    if (!text) return text.error();
    TomlFile file;
    file.path_ = path;
    try {
        file.root_ = toml::parse(*text, path.string());
    } catch (const toml::parse_error& error) {
        return Error{path.string(), "line " + std::to_string(error.source().begin.line) + ": " +
                                        std::string(error.description())};
    }
    return file;
}

void TomlFile::complain(const toml::node* where, std::string reason) {
    if (first_) return;
    const auto line = where ? where->source().begin.line : 0;
    first_ = Error{path_.string(), line ? "line " + std::to_string(line) + ": " + reason : reason};
}

Status TomlFile::status() const {
    if (first_) return *first_;
    return Done{};
}

const toml::node* TomlTable::at(std::string_view key) {
    read_.emplace(key);
    return table_.get(key);
}

void TomlTable::complain(std::string_view key, std::string reason) {
    const toml::node* node = table_.get(key);
    file_.complain(node ? node : &table_, "\"" + std::string(key) + "\" " + reason);
}

void TomlTable::need(std::string_view key) {
    if (!has(key)) complain(key, "is missing");
}

void TomlTable::number(std::string_view key, float& value, float low, float high) {
    const toml::node* node = at(key);
    if (!node) return;
    const auto read = node->value<double>();
    if (!node->is_number() || !read || !(*read >= low && *read <= high))
        complain(key, "must be a number from " + compact(low) + " to " + compact(high));
    else
        value = static_cast<float>(*read);
}

void TomlTable::whole(std::string_view key, int64_t& value, int64_t low, int64_t high) {
    const toml::node* node = at(key);
    if (!node) return;
    const auto read = node->is_integer() ? node->value<int64_t>() : std::nullopt;
    if (!read || *read < low || *read > high)
        complain(key, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    else
        value = *read;
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

void TomlTable::range(std::string_view key, float& first, float& second, float low, float high) {
    const toml::node* node = at(key);
    if (!node) return;
    const auto* pair = node->as_array();
    const auto a = pair && pair->size() == 2 ? (*pair)[0].value<double>() : std::nullopt;
    const auto b = pair && pair->size() == 2 ? (*pair)[1].value<double>() : std::nullopt;
    if (!a || !b || !(*a >= low && *a <= *b && *b <= high)) {
        complain(key, "must be [low, high] within " + compact(low) + " to " + compact(high));
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

const toml::table* TomlTable::table(std::string_view key) {
    const toml::node* node = at(key);
    if (!node) return nullptr;
    if (!node->is_table()) complain(key, "must be a table");
    return node->as_table();
}

void TomlTable::finish() {
    for (const auto& [key, node] : table_)
        if (!read_.contains(key.str()))
            file_.complain(&node, "unknown key \"" + std::string(key.str()) + "\"");
}

} // namespace shoal::game
