#include "lab/verify/shadow_feed.hpp"

#include <algorithm>
#include <charconv>

#include <glm/gtc/type_ptr.hpp>

namespace gobo::verify {
namespace {

/// A member of one shadow, by the address of its first number. Setting it makes the shadow, and those before
/// it, where there are fewer.
template <class Access>
Field field(std::size_t index, std::size_t components, Access access) {
    return {[=](const Sample& sample) {
                const double* first = access(sample.scene.shadows[index]);
                return std::vector<double>(first, first + components);
            },
            [=](Sample& sample, const std::vector<double>& values) {
                std::vector<oracle::Shadow>& all = sample.scene.shadows;
                if (all.size() <= index) all.resize(index + 1);
                std::copy_n(values.begin(), std::min(values.size(), components), access(all[index]));
            }};
}

}  // namespace

std::optional<Field> shadow_field(std::string_view name) {
    constexpr std::string_view prefix = "Shadows.shadows[";
    if (!name.starts_with(prefix)) return std::nullopt;
    name.remove_prefix(prefix.size());
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
    name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    using oracle::Shadow;
    const auto number = [&](double Shadow::*member) {
        return field(index, 1, [member](auto& shadow) { return &(shadow.*member); });
    };
    if (name == "].toMap")
        return field(index, 16, [](auto& shadow) { return glm::value_ptr(shadow.to_map); });
    if (name == "].layer") return number(&Shadow::layer);
    if (name == "].depthScale") return number(&Shadow::depth_scale);
    if (name == "].depthShift") return number(&Shadow::depth_shift);
    if (name == "].spread") return number(&Shadow::spread);
    return std::nullopt;
}

}  // namespace gobo::verify
