// The probes that applications get are those of data/, and what is said of their energy is right.
#include "gobo/light_probes.hpp"

#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

TEST(LightProbes, AreThoseOfTheData) {
    const std::string text = DiskFileSystem().read(GOBO_SOURCE_DIR "/data/light_probes.csv").value();
    std::vector<std::string> lines = split(text, '\n');
    ASSERT_EQ(lines.size(), 1 + 9 * light_probes.size());
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        const std::vector<std::string> cells = split(lines[i + 1], ',');
        const NamedLightProbe& probe = light_probes[i / 9];
        ASSERT_EQ(cells.size(), 5U) << lines[i + 1];
        EXPECT_EQ(cells[0], probe.name);
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_EQ(std::stof(cells[2 + channel]), probe.coefficients[i % 9][channel]) << lines[i + 1];
    }
}

/// A small light in direction +z: the basis functions there.
LightProbe small_light() {
    LightProbe probe{};
    probe[0] = {0.282095F, 0.282095F, 0.282095F};
    probe[2] = {0.488603F, 0.488603F, 0.488603F};
    probe[6] = {0.630783F, 0.630783F, 0.630783F};
    return probe;
}

/// The hard case of ringing harmonics.
TEST(LightProbes, TellTheEnergyThatClampingAdds) {
    // E = 1/4 + c/2 + 5 (3 c^2 - 1) / 32 is negative for c between its roots -0.823929 and -0.242738. The
    // integral there is -0.0153368, half of it the mean over the sphere, whose mean of E is 1/4: 3.07 %.
    const auto added = energy_added_by_clamping(small_light());
    EXPECT_NEAR(added[0], 0.0153368 / 2 / 0.25, 1e-4);
    EXPECT_LT(irradiance(small_light(), 0.8459, 0, -0.5333)[0], -0.035);
    LightProbe constant{};
    constant[0] = {1, 2, 0};
    EXPECT_EQ(energy_added_by_clamping(constant), (std::array<double, 3>{0, 0, 0}));
}

TEST(LightProbes, OfRealPlacesAreHardlyEverNegative) {
    for (const NamedLightProbe& probe : light_probes)
        for (const double added : energy_added_by_clamping(probe.coefficients))
            EXPECT_LT(added, 0.05) << probe.name;
}

}  // namespace
}  // namespace gobo
