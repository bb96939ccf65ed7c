#include "family/selection.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/cover.hpp"
#include "family/key.hpp"
#include "family/key_space.hpp"

namespace gobo {
namespace {

/// A default set is all keys up to this many, unless the family declares it.
constexpr std::uint64_t small_family = 256;

/// A cover of these takes minutes; the time grows by more than their number.
constexpr double most_combinations = 2e7;

Result<Key> named_key(const Family& family, const NamedKey& named, std::string_view dialect) {
    GOBO_TRY(Key key, parse_key(family, named.text, named.place));
    key = canonical(family, std::move(key), dialect);
    const Rule* rule = forbidding_rule(family, key, dialect);
    if (rule == nullptr) return key;
    return fail({.fault = Fault::usage,
                 .place = named.place,
                 .message = fmt::format("family '{}' forbids the key '{}': {}", family.name,
                                        key_text(family, key), rule->reason),
                 .quoted_line = named.place.file.empty() ? "" : named.text,
                 .help = fmt::format("choose another value; the rule is in {}:{}", rule->place.file,
                                     rule->place.line)});
}

/// The limits of what a selection means, `selection`, and of what was asked for.
Result<KeySpaceLimits> limits_of(const Family& family, const Selection& selection, const Selection& asked) {
    KeySpaceLimits limits;
    limits.excluded = selection.excluded;
    for (const std::string& name : selection.over) {
        const auto index = family.index_of(name);
        if (!index)
            return fail(Fault::usage,
                        fmt::format("--over: family '{}' has no feature '{}'", family.name, name),
                        help_for(family.features, name));
        limits.over.push_back(*index);
    }
    std::set<std::string> conditions = {selection.where, asked.where};
    conditions.erase("");
    for (const std::string& condition : conditions) {
        const Fault fault = condition == asked.where ? Fault::usage : Fault::input;
        GOBO_TRY(Expression where, parse_expression(condition, family.features, {}, fault));
        limits.where.push_back(std::move(where));
    }
    return limits;
}

/// What the selection means: itself, or the family's default set where it names nothing. The conditions of
/// both hold then.
Result<Selection> resolved(const Family& family, const Selection& selection, std::string_view dialect) {
    if (!selection.names_nothing()) return selection;
    Selection meant = family.default_selection.value_or(selection);
    if (!family.default_selection) {
        GOBO_TRY(const KeySpace space, KeySpace::make(family, dialect, {}));
        meant.all = space.count().saturated() <= small_family;
        meant.cover = meant.all ? 0 : 2;
        return meant;
    }
    meant.excluded = selection.excluded;
    if (!selection.over.empty()) meant.over = selection.over;
    return meant;
}

/// A bound on the keys that a cover needs at least: the product of the most values that `strength` features
/// take somewhere in the space. Rules may make it fewer.
std::uint64_t largest_product(const KeySpace& space, std::size_t strength) {
    const OpenPaths paths(space);
    std::vector<std::uint64_t> counts;
    for (std::size_t feature = 0; feature < space.feature_count(); ++feature)
        counts.push_back(std::ranges::count(paths.allowed(feature), 1));
    std::ranges::sort(counts, std::greater());
    counts.resize(std::min(counts.size(), strength));
    std::uint64_t product = 1;
    for (std::size_t i = 0; i < counts.size() && product <= most_keys; ++i) product *= counts[i];
    return product;
}

/// How many combinations of the values of `strength` features that vary there are.
double combinations(const KeySpace& space, std::size_t strength) {
    const OpenPaths paths(space);
    std::vector<double> of(strength + 1, 0);  // by the number of features, of those up to here
    of[0] = 1;
    for (std::size_t feature = 0; feature < space.feature_count(); ++feature) {
        const auto values = static_cast<double>(std::ranges::count(paths.allowed(feature), 1));
        for (std::size_t chosen = strength; chosen > 0 && values > 1; --chosen)
            of[chosen] += of[chosen - 1] * values;
    }
    return of[strength];
}

/// The number of values of the features that an expression looks at.
std::size_t values_of(const Family& family, const Expression& expression) {
    std::size_t count = 0;
    for (const std::vector<int>& features : {expression.features, expression.subtracted})
        for (const int feature : features) count += family.features[feature].values.size();
    for (const Expression& part : expression.parts) count += values_of(family, part);
    return count;
}

/// ", most by the rule in FILE:LINE": that whose condition looks at most values; empty where there are no
/// rules.
std::string widest_rule(const Family& family, std::string_view dialect) {
    const Rule* widest = nullptr;
    std::size_t most = 0;
    for (const Rule& rule : family.rules) {
        const std::size_t values = applies_in(rule, dialect) ? values_of(family, rule.when) : 0;
        if (values > most) widest = &rule;
        most = std::max(most, values);
    }
    if (widest == nullptr) return "";
    return fmt::format(", most by the rule in {}:{}", widest->place.file, widest->place.line);
}

/// What `all` and `cover` give.
Result<std::vector<Key>> keys_of_space(const Family& family, const Selection& selection,
                                       const KeySpaceLimits& limits, std::string_view dialect) {
    if (!selection.all && selection.cover <= 0) return std::vector<Key>{};
    GOBO_TRY(const KeySpace space, KeySpace::make(family, dialect, limits));
    const WholeNumber count = space.count();
    if (selection.all && count.saturated() > most_keys)
        return fail(Fault::usage, fmt::format("--all means {} keys, more than {}", count.text(), most_keys),
                    "name the features to vary with --over, or a condition with --where");
    if (selection.all) return space.keys();
    const char* const help =
        "lower the strength, name the features to vary with --over, or a condition with --where";
    if (count.saturated() > most_keys && largest_product(space, selection.cover) > most_keys)
        return fail(Fault::usage,
                    fmt::format("--cover {} takes more than {} keys", selection.cover, most_keys), help);
    if (selection.cover < std::ssize(family.features) &&
        combinations(space, selection.cover) > most_combinations)
        return fail(Fault::usage,
                    fmt::format("--cover {} means {:.1e} combinations of values, more than {:.0e}",
                                selection.cover, combinations(space, selection.cover), most_combinations),
                    help);
    if (std::optional<std::vector<Key>> keys = cover(space, selection.cover)) return *std::move(keys);
    return fail(Fault::usage,
                fmt::format("family '{}' ties so many values together that --cover {} takes too long{}",
                            family.name, selection.cover, widest_rule(family, dialect)),
                help);
}

}  // namespace

Result<std::vector<Key>> select(const Family& family, const Selection& asked, std::string_view dialect) {
    GOBO_TRY(const Selection selection, resolved(family, asked, dialect));
    GOBO_TRY(const KeySpaceLimits limits, limits_of(family, selection, asked));
    GOBO_TRY(std::vector<Key> keys, keys_of_space(family, selection, limits, dialect));
    for (const NamedKey& named : selection.keys) {
        GOBO_TRY(Key key, named_key(family, named, dialect));
        if (std::ranges::all_of(limits.where, [&](const Expression& where) { return holds(where, key); }))
            keys.push_back(std::move(key));
    }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

Result<WholeNumber> count_selected(const Family& family, const Selection& asked, std::string_view dialect) {
    GOBO_TRY(const Selection selection, resolved(family, asked, dialect));
    if (!selection.all || !selection.keys.empty()) {
        GOBO_TRY(const std::vector<Key> keys, select(family, asked, dialect));
        return keys.size();
    }
    GOBO_TRY(const KeySpaceLimits limits, limits_of(family, selection, asked));
    GOBO_TRY(const KeySpace space, KeySpace::make(family, dialect, limits));
    return space.count();
}

std::vector<NamedKey> keys_of_text(std::string_view text, const std::string& path) {
    std::vector<NamedKey> keys;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // of an editor
    for (int line = 1; !text.empty(); ++line) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view whole = text.substr(0, end);
        const std::string_view content = trim(whole.substr(0, whole.find('#')));
        if (!content.empty()) keys.push_back({std::string(content), {path, line, 0}});
        text.remove_prefix(end);
        text.remove_prefix(std::min<std::size_t>(text.starts_with("\r\n") ? 2 : 1, text.size()));
    }
    return keys;
}

}  // namespace gobo
