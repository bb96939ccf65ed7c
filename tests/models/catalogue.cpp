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
        if (!node.is_table()) {
            reader.error(node, "a model is a table",
                         "write [ID] above its title, family, key, where and pieces");
            continue;
        }
        const TomlTable table(reader, *node.as_table(), "model");
        table.only({"title", "family", "key", "where", "pieces"});
        by_line[node.source().begin.line] = {std::string(id.str()),
                                             table.required_string("title"),
                                             table.string("family").value_or("lit"),
                                             table.required_string("key"),
                                             table.required_string("where"),
                                             table.strings("pieces")};
    }
    if (reader.failed()) return tl::unexpected(reader.errors());
    std::vector<Model> models;
    for (auto& [line, model] : by_line) models.push_back(std::move(model));
    return models;
}

}  // namespace gobo::models
