#include "page.hpp"

#include <algorithm>
#include <cmath>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compose/compose.hpp"
#include "family/expression.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo::models {
namespace {

constexpr const char* kHeading = R"(# The lighting models

Every lighting model of the classic texts, and of physically based surfaces: a permutation that has it as an example, the files with its pieces, a picture, and the largest errors that `gobo test` found over all permutations that have it, in single precision
(fp32) and, for the same shader, in double precision (fp64), both relative to the largest term of the light ([verification](verification.md)). The permutations are those of `gobo test lit
--cover 3`, of `gobo test pbr --cover 2` and, for the ubershader, those of `tests/ubershader`. They mix models and qualities, so the largest errors are those of `spot_edge=cosine`, which resolves narrow cones no better than a cosine in single
precision does ([quality](quality.md#the-rim-of-a-cone-spot_edge)). [Numerics](numerics.md) names models by these ids. One command writes this page, its pictures and its figures; a test fails
where it is out of date:

```
cmake --build --preset release --target models
```

| id | model | example | pieces | picture | fp32 | fp64 | over |
|---|---|---|---|---|---|---|---|
)";

/// A family, and what its measured permutations came out as.
struct Measured {
    Family family;
    const Figures* figures = nullptr;
};

/// The largest errors of the permutations that have a model.
struct Largest {
    double fp32 = 0;
    double fp64 = 0;
    std::uint64_t points = 0;
    std::size_t permutations = 0;
};

Result<Largest> largest_of(const Measured& measured, const Expression& where) {
    Largest largest;
    for (const PermutationFigures& row : measured.figures->permutations) {
        const Result<Key> key = parse_key(measured.family, row.key);
        if (!key) return tl::unexpected(key.error());
        if (!holds(where, *key)) continue;
        largest.fp32 = std::max(largest.fp32, row.fp32);
        largest.fp64 = std::max(largest.fp64, row.fp64);
        largest.points += row.points;
        ++largest.permutations;
    }
    return largest;
}

Result<Composition> compose_example(const FileSystem& files, const std::string& root, const Family& family,
                                    const Key& key) {
    SearchPath search;
    if (family.name == "uber") search.add(files, root + "/tests/ubershader", "tests/ubershader/", false);
    search.add(files, root + "/shader_lib", "shader_lib/", false);
    search.add(files, root + "/templates", "templates/", false);
    return compose(family, {key}, search, Dialect::own);
}

/// "shader_lib/fog.glsl" of "fog.glsl".
std::string path_of(const std::string& piece) {
    return piece.starts_with("tests/") ? piece : "shader_lib/" + piece;
}

/// A file of pieces with a link to it.
std::string link_to(const std::string& piece) {
    return fmt::format("[{}](../{})", piece, path_of(piece));
}

/// A file of which the example has no piece; empty where there is none.
std::string absent(const Composition& example, const std::vector<std::string>& files) {
    for (const std::string& file : files) {
        const std::string path = path_of(file);
        const bool is_there = std::any_of(
            example.pieces.begin(), example.pieces.end(),
            [&](const Piece& piece) { return piece.name == path || piece.name.starts_with(path + "#"); });
        if (!is_there) return file;
    }
    return "";
}

Result<std::string> row_of(const FileSystem& files, const std::string& root, const Model& model,
                           const Measured& measured) {
    const Family& family = measured.family;
    const auto refuse = [&](const std::string& message, const std::string& help) {
        return fail(Fault::input, fmt::format("{}: {}", model.id, message), help);
    };
    const Result<Key> key = parse_key(family, model.key);
    if (!key) return tl::unexpected(key.error());
    const Result<Expression> where = parse_expression(model.where, family.features, {}, Fault::input);
    if (!where) return tl::unexpected(where.error());
    if (!holds(*where, *key))
        return refuse(fmt::format("'{}' has not the model", model.key), "fix docs/models.toml");
    const Result<Composition> example = compose_example(files, root, family, *key);
    if (!example) return tl::unexpected(example.error());
    if (model.pieces.empty()) return refuse("no pieces say it", "name their files in docs/models.toml");
    if (const std::string file = absent(*example, model.pieces); !file.empty())
        return refuse(fmt::format("the example has no piece of '{}'", file), "mend docs/models.toml");
    const Result<Largest> largest = largest_of(measured, *where);
    if (!largest) return tl::unexpected(largest.error());
    if (largest->permutations == 0) return refuse("no measured permutation has it", "measure a larger cover");
    const std::string picture = fmt::format("pictures/models/{}.png", model.id);
    if (!files.is_file(fmt::format("{}/docs/{}", root, picture)))
        return refuse(fmt::format("there is no docs/{}", picture), "build the target models");
    std::vector<std::string> links;
    for (const std::string& piece : model.pieces) links.push_back(link_to(piece));
    return fmt::format(
        "| {} | {} | `{}: {}` | {} | ![{}]({}) | {:.1e} | {:.1e} | {} points, {} permutations |\n", model.id,
        model.title, model.family, key_text(family, *key), fmt::join(links, ", "), model.id, picture,
        largest->fp32, largest->fp64, largest->points, largest->permutations);
}

Result<Family> family_of(const FileSystem& files, const std::string& root, const std::string& name) {
    const std::string path =
        fmt::format("{}/{}.toml", name == "uber" ? "tests/ubershader" : "templates", name);
    const Result<std::string> text = files.read(root + "/" + path);
    if (!text) return tl::unexpected(text.error());
    return read_family(*text, path, [&](const std::string& base) -> Result<FamilyText> {
        const std::string base_path = fmt::format("templates/{}.toml", base);
        const Result<std::string> base_text = files.read(root + "/" + base_path);
        if (!base_text) return tl::unexpected(base_text.error());
        return FamilyText{*base_text, base_path};
    });
}

const std::regex& measured_number() {
    static const std::regex number(R"(\b[0-9]\.[0-9]e[-+][0-9]{2}\b)");
    return number;
}

}  // namespace

Result<std::string> models_page(const FileSystem& files, const std::string& root,
                                const std::vector<Model>& models,
                                const std::map<std::string, Figures>& figures) {
    std::map<std::string, Measured> measured;
    for (const auto& [name, run] : figures) {
        Result<Family> family = family_of(files, root, name);
        if (!family) return tl::unexpected(family.error());
        measured[name] = {std::move(*family), &run};
    }
    std::string page = kHeading;
    for (const Model& model : models) {
        const auto of_family = measured.find(model.family);
        if (of_family == measured.end())
            return fail(Fault::input,
                        fmt::format("{}: no figures of the family '{}' were given", model.id, model.family));
        const Result<std::string> row = row_of(files, root, model, of_family->second);
        if (!row) return tl::unexpected(row.error());
        page += *row;
    }
    return page;
}

bool say_the_same(std::string_view page, std::string_view other) {
    const std::string first(page);
    const std::string second(other);
    const std::regex& number = measured_number();
    if (std::regex_replace(first, number, "#") != std::regex_replace(second, number, "#")) return false;
    std::sregex_iterator left(first.begin(), first.end(), number);
    std::sregex_iterator right(second.begin(), second.end(), number);
    for (const std::sregex_iterator end; left != end; ++left, ++right) {
        const double a = std::stod(left->str());
        const double b = std::stod(right->str());
        if (std::abs(a - b) > 0.1 * std::max(a, b)) return false;
    }
    return true;
}

}  // namespace gobo::models
