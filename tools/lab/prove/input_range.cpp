#include "lab/prove/input_range.hpp"

namespace gobo::prove {
namespace {

/// What a built-in input may hold beyond what the sanitizer draws of it; nothing of other inputs.
Range drawn_beyond(const sanitize::InputField& field, std::size_t component) {
    const bool is_declared = field.domain.place.line > 0;
    if (field.name == "gl_FragCoord") {
        // The sanitizer's pixels are where it puts them, whatever the domain says.
        if (component == 3) return is_declared ? exactly(1) : between(0, 1e6);
        if (component < 2) return is_declared ? between(0.5, 63.5) : between(0x1p-8, 16384);
        return kNothing;
    }
    if (is_declared) return kNothing;
    for (const char* counter :
         {"gl_VertexID", "gl_VertexIndex", "gl_InstanceID", "gl_InstanceIndex", "gl_PrimitiveID",
          "gl_BaseInstance", "gl_DrawID", "gl_Layer", "gl_ViewportIndex"})
        if (field.name == counter) return whole_between(0, kAnyInt.high);
    if (field.name.starts_with("gl_BaseVertex") || field.name.starts_with("gl_SampleMask")) return kAnyInt;
    if (field.name.starts_with("gl_ClipDistance") || field.name.starts_with("gl_CullDistance"))
        return between(-kLargestFloat, kLargestFloat);
    return kNothing;
}

}  // namespace

Range whole_numbers(Scalar scalar, double low, double high) {
    low = std::round(low);
    high = std::round(high);
    if (scalar == Scalar::uint32 && low > kAnyInt.high && high <= kAnyUint.high)
        return whole_between(low - 0x1p32, high - 0x1p32);
    if (low < (scalar == Scalar::uint32 ? 0 : kAnyInt.low) || high > kAnyInt.high) return kAnyInt;
    return whole_between(low, high);
}

Range range_of(const sanitize::InputField& field, std::size_t component, bool has_tiny_inputs) {
    const bool is_last = component >= field.ranged();
    const Domain& domain = is_last ? field.domain : field.domain_of(component);
    if (is_last) {
        const Domain last = field.last_domain();
        Range range = between(nearest_float(last.low), nearest_float(last.high));
        range.least = last.low > 0 ? nearest_float(last.low) : 0;
        return hull(rounded(range), drawn_beyond(field, component));
    }
    if (domain.of_length) {
        const double most = nearest_float(domain.high * (1 + 0x1p-22));
        return hull(between(-most, most), drawn_beyond(field, component));
    }
    Range range = kNothing;
    const auto add = [&](double low, double high) {
        Range one = field.is_float() ? between(nearest_float(low), nearest_float(high))
                                     : whole_numbers(field.scalar, low, high);
        if (low == high && field.is_float()) one = exactly(nearest_float(low));
        const bool has_tiny_bound = (low != 0 && std::fabs(low) < sanitize::kSmallest) ||
                                    (high != 0 && std::fabs(high) < sanitize::kSmallest);
        if (!has_tiny_inputs && field.is_float() && !has_tiny_bound)
            one.least = std::max(one.least, nearest_float(sanitize::kSmallest));
        // A float at least so large is a multiple of its last place.
        if (field.is_float() && one.least > kSmallestNormal && low != high)
            one.grid = std::ilogb(one.least) - 23;
        range = hull(range, tidy(one));
    };
    add(domain.low, domain.high);
    for (const double also : domain.also) add(also, also);
    const Range beyond = drawn_beyond(field, component);
    const bool is_pixel = field.name == "gl_FragCoord" && component < 2 && domain.place.line == 0;
    range = is_pixel ? beyond : hull(range, beyond);
    if (field.scalar == Scalar::boolean) return kTruth;
    // Denormals count as 0 where they are flushed.
    if (field.is_float() && range.least < kSmallestNormal && range.low < kSmallestNormal &&
        range.high > -kSmallestNormal)
        range = hull(range, exactly(0));
    return range;
}

}  // namespace gobo::prove
