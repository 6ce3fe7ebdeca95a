// Reading our small TOML files strictly: every key known, every value of its type and in its range, or an
// error with its line. The first mistake is kept; later reads still return defaults, so callers check once at
// the end.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <toml++/toml.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace shoal::game {

class TomlFile {
  public:
    static Result<TomlFile> open(const Path& file);

    const toml::table& root() const { return root_; }
    void complain(const toml::node* where, std::string reason);
    Status status() const;
    const Path& path() const { return path_; }

  private:
    Path path_;
    toml::table root_;
    std::optional<Error> first_;
};

// One table of the file: each read names its key, finish() complains about keys that nobody read.
class TomlTable {
  public:
    TomlTable(TomlFile& file, const toml::table& table) : file_(file), table_(table) {}

    bool has(std::string_view key) const { return table_.contains(key); }
    int line() const { return static_cast<int>(table_.source().begin.line); }

    // Optional keys keep the default.
    void number(std::string_view key, float& value, float low, float high);
    void whole(std::string_view key, int64_t& value, int64_t low, int64_t high);
    void flag(std::string_view key, bool& value);
    void text(std::string_view key, std::string& value);
    // [low, high], low <= high
    void range(std::string_view key, float& first, float& second, float low, float high);
    const toml::array* list(std::string_view key);
    const toml::table* table(std::string_view key);
    void need(std::string_view key);
    void complain(std::string_view key, std::string reason);
    void finish();

  private:
    const toml::node* at(std::string_view key);

    TomlFile& file_;
    const toml::table& table_;
    std::set<std::string, std::less<>> read_;
};

} // namespace shoal::game
