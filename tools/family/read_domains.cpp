#include "family/read_domains.hpp"

#include <fmt/format.h>

namespace gobo {
namespace {

Domain read_domain(TomlReader& reader, std::string name, const toml::node& node) {
    Domain domain;
    domain.name = std::move(name);
    domain.place = reader.place_of(node);
    std::vector<double> range;
    if (const toml::table* table = node.as_table()) {
        reader.only(*table, fmt::format("the domain of '{}'", domain.name),
                    {"range", "length", "last", "also"});
        domain.of_length = table->contains("length");
        range = reader.numbers(*table, domain.of_length ? "length" : "range");
        domain.also = reader.numbers(*table, "also");
        domain.last = reader.numbers(*table, "last");
        if (!domain.last.empty() && (domain.last.size() != 2 || domain.last[0] > domain.last[1])) {
            reader.error(*table->get("last"), fmt::format("the domain of '{}' is no range", domain.name),
                         "write last = [low, high]");
        }
    } else {
        range = reader.numbers_of(node, domain.name);
    }
    if (range.size() != 2 || range[0] > range[1]) {
        reader.error(node, fmt::format("the domain of '{}' is no range", domain.name), "write [low, high]");
        return domain;
    }
    domain.low = range[0];
    domain.high = range[1];
    return domain;
}

}  // namespace

std::vector<Domain> read_domains(TomlReader& reader, const toml::table& root) {
    std::vector<Domain> domains;
    const toml::table* table = reader.table(root, "domain");
    if (table == nullptr) return domains;
    for (const auto& [key, node] : *table)
        domains.push_back(read_domain(reader, std::string(key.str()), node));
    return domains;
}

Result<std::vector<Domain>> read_domain_file(std::string_view text, const std::string& path) {
    TomlReader reader(text, path);
    reader.only(reader.root(), "the file", {"domain"});
    std::vector<Domain> domains = read_domains(reader, reader.root());
    if (reader.failed()) return tl::unexpected(reader.errors());
    return domains;
}

}  // namespace gobo
