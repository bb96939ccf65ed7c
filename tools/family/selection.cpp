#include "family/selection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/cover.hpp"
#include "family/key.hpp"
#include "family/key_space.hpp"

namespace gobo {
namespace {

/// A default set is all keys up to this many, unless the family declares it.
constexpr std::uint64_t small_family = 256;

tl::unexpected<Diagnostics> refused(const Family& family, const NamedKey& named, const Key& key,
                                    const Rule& rule) {
    Diagnostic diagnostic;
    diagnostic.fault = Fault::usage;
    diagnostic.place = named.place;
    if (!named.place.file.empty()) diagnostic.quoted_line = named.text;
    diagnostic.message =
        fmt::format("family '{}' forbids the key '{}': {}", family.name, key_text(family, key), rule.reason);
    diagnostic.help =
        fmt::format("choose another value; the rule is in {}:{}", rule.place.file, rule.place.line);
    return fail(std::move(diagnostic));
}

Result<Key> named_key(const Family& family, const NamedKey& named, std::string_view dialect) {
    Result<Key> key = parse_key(family, named.text, named.place);
    if (!key) return key;
    *key = canonical(family, std::move(*key), dialect);
    if (const Rule* rule = forbidding_rule(family, *key, dialect)) return refused(family, named, *key, *rule);
    return key;
}

Result<KeySpaceLimits> limits_of(const Family& family, const Selection& selection) {
    KeySpaceLimits limits;
    limits.retired = selection.retired;
    std::vector<std::string> names;
    for (const Feature& feature : family.features) names.push_back(feature.name);
    for (const std::string& name : selection.over) {
        const auto index = family.index_of(name);
        if (!index) {
            return fail(Fault::usage,
                        fmt::format("--over: family '{}' has no feature '{}'", family.name, name),
                        suggestion(name, names));
        }
        limits.over.push_back(*index);
    }
    if (!selection.where.empty()) {
        Result<Expression> where = parse_expression(selection.where, family.features, {}, Fault::usage);
        if (!where) return tl::unexpected(where.error());
        limits.where.push_back(std::move(*where));
    }
    return limits;
}

/// What the selection means: itself, or the family's default set where it names nothing.
Selection resolved(const Family& family, const Selection& selection, std::string_view dialect) {
    if (!selection.names_nothing()) return selection;
    Selection meant = selection;
    if (!family.default_selection) {
        KeySpaceLimits all;
        meant.all = KeySpace(family, dialect, all).count() <= small_family;
        meant.cover = meant.all ? 0 : 2;
        return meant;
    }
    const DefaultSelection& declared = *family.default_selection;
    for (const std::string& text : declared.keys) meant.keys.push_back({text, {}});
    meant.all = declared.all;
    meant.cover = declared.cover;
    if (meant.over.empty()) meant.over = declared.over;
    if (meant.where.empty()) {
        meant.where = declared.where;
    } else if (!declared.where.empty()) {
        meant.where = fmt::format("({}) && ({})", declared.where, meant.where);
    }
    return meant;
}

/// A bound on the keys that a cover needs at least: the product of the most values that `strength` features
/// take somewhere in the space. Rules may make it fewer.
std::uint64_t largest_product(const KeySpace& space, int strength) {
    std::vector<std::uint64_t> counts;
    for (std::size_t feature = 0; feature < space.feature_count(); ++feature) {
        PartialKey key(space.feature_count(), -1);
        std::uint64_t count = 0;
        for (int value = 0; value < space.value_count(feature); ++value) {
            key[feature] = value;
            count += space.contains(key) ? 1 : 0;
        }
        counts.push_back(count);
    }
    std::sort(counts.rbegin(), counts.rend());
    std::uint64_t product = 1;
    for (std::size_t i = 0; i < counts.size() && i < static_cast<std::size_t>(strength); ++i) {
        product *= counts[i];
        if (product > most_keys) break;  // before it could overflow
    }
    return product;
}

Result<std::vector<Key>> keys_of_space(const KeySpace& space, const Selection& selection) {
    std::vector<Key> keys;
    if (selection.all && space.count() > most_keys) {
        return fail(Fault::usage, fmt::format("--all means {} keys, more than {}", space.count(), most_keys),
                    "name the features to vary with --over, or a condition with --where");
    }
    if (selection.all) return space.keys();
    if (selection.cover > 0 && space.count() > most_keys &&
        largest_product(space, selection.cover) > most_keys) {
        return fail(Fault::usage,
                    fmt::format("--cover {} takes more than {} keys", selection.cover, most_keys),
                    "lower the strength, name the features to vary with --over, or a condition with --where");
    }
    if (selection.cover > 0) return cover(space, selection.cover);
    return keys;
}

}  // namespace

Result<std::vector<Key>> select(const Family& family, const Selection& asked, std::string_view dialect) {
    const Selection selection = resolved(family, asked, dialect);
    const Result<KeySpaceLimits> limits = limits_of(family, selection);
    if (!limits) return tl::unexpected(limits.error());
    Result<std::vector<Key>> keys = keys_of_space(KeySpace(family, dialect, *limits), selection);
    if (!keys) return keys;
    for (const NamedKey& named : selection.keys) {
        Result<Key> key = named_key(family, named, dialect);
        if (!key) return tl::unexpected(key.error());
        if (limits->where.empty() || holds(limits->where.front(), *key)) keys->push_back(std::move(*key));
    }
    std::sort(keys->begin(), keys->end());
    keys->erase(std::unique(keys->begin(), keys->end()), keys->end());
    return keys;
}

Result<std::uint64_t> count_selected(const Family& family, const Selection& asked, std::string_view dialect) {
    const Selection selection = resolved(family, asked, dialect);
    if (selection.all && selection.keys.empty()) {
        const Result<KeySpaceLimits> limits = limits_of(family, selection);
        if (!limits) return tl::unexpected(limits.error());
        return KeySpace(family, dialect, *limits).count();
    }
    const Result<std::vector<Key>> keys = select(family, selection, dialect);
    if (!keys) return tl::unexpected(keys.error());
    return keys->size();
}

std::vector<NamedKey> keys_of_text(std::string_view text, const std::string& path) {
    std::vector<NamedKey> keys;
    for (int line = 1; !text.empty(); ++line) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view content = trim(text.substr(0, std::min(end, text.find('#'))));
        if (!content.empty()) keys.push_back({std::string(content), {path, line, 0}});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return keys;
}

}  // namespace gobo
