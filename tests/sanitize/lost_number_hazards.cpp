// Numbers too small for 16-bit floats: where they matter, and where they are as good as 0.
#include "hazards.hpp"
#include "lab/sanitize/lost_numbers.hpp"

namespace gobo {
namespace {

Hazard lost(std::string name, HazardSource hazard, HazardSource guarded, std::vector<Domain> domains) {
    return {std::move(name),    std::string(sanitize::kLostNumber),
            std::move(hazard),  std::move(guarded),
            std::move(domains), Setting::mediump_flushed};
}

}  // namespace

std::vector<Hazard> lost_number_hazards() {
    return {
        lost("lost_square", {"float w = x * x * 1e-3; c.r = w * 1e4;"},
             {"float w = x * x * 1e-3; c.r = 1.0 + w;"}, {domain("x", 0, 1)}),
        lost("lost_attenuation", {"float fade = 1.0 / (x * x); c.r = min(fade * 2e4, 1.0);"},
             {"float d = x * 0.01; float fade = 1.0 / (d * d); c.r = min(fade * 2.0, 1.0);"},
             {domain("x", 10, 250)}),
        lost("lost_product_of_attenuations",
             {"float fade = 1.0 / (1.0 + x * x); float cone = y * y; c.r = fade * cone * cone * 3e4;"},
             {"float fade = 1.0 / (1.0 + x * x); float cone = y * y; c.r = fade * cone * cone;"},
             {domain("x", 0, 100), domain("y", 0, 1)}),
        lost("lost_derivative", {"float w = fwidth(x) * 1e-3; c.r = min(w * 3e4, 1.0);"},
             {"c.r = min(fwidth(x) * 30.0, 1.0);"}, {domain("x", 0, 1)}),
        lost("lost_luminance",
             {"float dark = dot(v, vec3(0.2126, 0.7152, 0.0722)); c.r = pow(dark, 0.4545);"},
             {"float dark = dot(v, vec3(0.2126, 0.7152, 0.0722)); c.r = pow(max(dark, 0.001), 0.4545);"},
             {domain("v", 0, 1)}),
        lost("lost_depth_bias",
             {"float bias = x * 5e-6; c.r = gap < bias ? 1.0 : 0.0;", "in highp float gap;"},
             {"highp float slope = x; highp float bias = slope * 5e-6; c.r = gap < bias ? 1.0 : 0.0;",
              "in highp float gap;"},
             {domain("x", 0.001, 1), domain("gap", 0, 1e-5)}),
        lost("lost_fog", {"float fog = exp(-x * x); c.r = min(fog * sun, 1.0);", "uniform float sun;"},
             {"float fog = exp(-x * x); c.r = min(fog * min(sun, 50.0), 1.0);", "uniform float sun;"},
             {domain("x", 0, 4), domain("sun", 0, 30000)}),
        lost("lost_length_beside_its_guard",
             {"float l = dot(p, p); c.rgb = l > 0.0 ? p * inversesqrt(l) : vec3(0);", "in mediump vec3 p;"},
             {"highp float l = dot(p, p); c.rgb = l > 0.0 ? p * inversesqrt(l) : vec3(0);",
              "in highp vec3 p;"},
             {domain("p", -0.01, 0.01)}),
        lost("lost_power_of_roughness", {"float a = x * x; c.r = min(a * a / 1e-4, 1.0);"},
             {"float a = x * 10.0; c.r = min(a * a * a * a, 1.0);"}, {domain("x", 0.02, 1)}),
        lost("lost_uniform", {"c.r = density * 1e4;", "uniform mediump float density;"},
             {"highp float fog = density * 1e4; c.r = fog;", "uniform highp float density;"},
             {domain("density", 0, 1e-4)}),
        lost("lost_where_it_is_stored",
             {"mediump float m = a; highp float h = m; c.r = min(h * 1e6, 1.0);", "in highp float a;"},
             {"highp float m = a; c.r = min(m * 1e6, 1.0);", "in highp float a;"}, {domain("a", 0, 1e-5)}),
        lost("lost_constant", {"c.r = x * 1e-8 * 3e4 * 3e4;"}, {"c.r = x * 9.0 + 1e-8;"},
             {domain("x", 0, 1)}),
        lost("lost_element",
             {"float t[2]; t[0] = t[1] = 0.0; t[i & 1] = x * 1e-4; c.r = (t[0] + t[1]) * 2e4;"},
             {"float t[2]; t[0] = t[1] = 0.0; t[i & 1] = x; c.r = (t[0] + t[1]) * 2.0;"},
             {domain("x", 0, 1)}),
        lost("lost_in_a_whole_number",
             {"k = x * x * 1e4 > 0.1 ? 5 : 0; c.r = x;", "layout(location = 1) out mediump int k;"},
             {"highp float w = x; k = w * w * 1e4 > 0.1 ? 5 : 0; c.r = x;",
              "layout(location = 1) out mediump int k;"},
             {domain("x", 0.001, 0.0075)}),
        lost("lost_side_of_a_light", {"c.r = dot(n, l) * 1e-4 * 1e-5 > 0.0 ? 0.8 : 0.2;", "in vec3 n, l;"},
             {"c.r = dot(n, l) >= 0.0 ? 0.8 : 0.2;", "in vec3 n, l;"},
             {{"n", 1, 1, true, {}, {}, {}}, {"l", 1, 1, true, {}, {}, {}}}),
        lost("lost_result_of_a_function",
             {"c.r = thin(x) * 3e4;", "mediump float thin(highp float t) { return t * 1e-5; }"},
             {"c.r = thin(x);", "mediump float thin(highp float t) { return t * 1e-5; }"},
             {domain("x", 0.01, 1)}),
        lost("lost_in_a_sum", {"float s = 0.0; for (int k = 0; k < 4; ++k) s += x * 1e-5; c.r = s * 3e4;"},
             {"float s = 0.0; for (int k = 0; k < 4; ++k) s += x * 1e-5; c.r = s + y;"},
             {domain("x", 0, 1), domain("y", 0, 1)}),
        lost("lost_before_discard", {"if (x * x * 1e-4 == 0.0) discard; c.r = 1.0;"},
             {"if (x == 0.0) discard; c.r = 1.0;"}, {domain("x", 0.01, 1)}),
        // A cosine at grazing light is 0 or nearly so: a rounding decides whether there is a highlight.
        lost("lost_vector_beside_a_highlight",
             {"vec3 l = v * 1e-4; float n = l.z; c.r = n > 0.0 ? 1.0 : 0.0;"},
             {"float n = v.z; c.r = n > 0.0 ? 1.0 : 0.0;"}, {domain("v.x", 1, 1), domain("v.z", -1, 1)}),
    };
}

}  // namespace gobo
