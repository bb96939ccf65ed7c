#include "catalogue.hpp"

#include <cstdint>
#include <map>

#include "family/toml_reader.hpp"

namespace gobo::models {

Result<std::vector<Model>> read_catalogue(std::string_view toml, const std::string& path) {
    TomlReader reader(toml, path);
    std::map<std::uint32_t, Model>
        by_line;  // the parser's table is sorted by name: S10 would stand before S2
    for (const auto& [id, node] : reader.root()) {
        const toml::table* table = node.as_table();
        if (table == nullptr) {
            reader.error(node, "a model is a table",
                         "write [ID] above its title, family, key, where and pieces");
            continue;
        }
        reader.only(*table, "model", {"title", "family", "key", "where", "pieces"});
        by_line[node.source().begin.line] = {std::string(id.str()),
                                             reader.required_string(*table, "model", "title"),
                                             reader.string(*table, "family").value_or("lit"),
                                             reader.required_string(*table, "model", "key"),
                                             reader.required_string(*table, "model", "where"),
                                             reader.strings(*table, "pieces")};
    }
    if (reader.failed()) return tl::unexpected(reader.errors());
    std::vector<Model> models;
    for (auto& [line, model] : by_line) models.push_back(std::move(model));
    return models;
}

}  // namespace gobo::models
