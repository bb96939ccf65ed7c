#include "lab/cost/chips.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::cost {

const std::vector<Chip>& chips() {
    static const std::vector<Chip> kChips = {
        {"tahiti", "GCN1", "Radeon HD 7970"},
        {"pitcairn", "GCN1", "Radeon HD 7870"},
        {"bonaire", "GCN2", "Radeon HD 7790"},
        {"hawaii", "GCN2", "Radeon R9 290"},
        {"tonga", "GCN3", "Radeon R9 285"},
        {"fiji", "GCN3", "Radeon R9 Fury"},
        {"polaris10", "GCN4", "Radeon RX 480"},
        {"polaris11", "GCN4", "Radeon RX 460"},
        {"polaris12", "GCN4", "Radeon RX 550"},
        {"vega10", "GCN5", "Radeon RX Vega 64"},
        {"vega20", "GCN5", "Radeon VII"},
        {"raven", "GCN5", "Ryzen 2000G"},
        {"renoir", "GCN5", "Ryzen 4000G"},
        {"navi10", "RDNA1", "Radeon RX 5700"},
        {"navi14", "RDNA1", "Radeon RX 5500"},
        {"navi21", "RDNA2", "Radeon RX 6800"},
        {"navi22", "RDNA2", "Radeon RX 6700"},
        {"navi23", "RDNA2", "Radeon RX 6600"},
        {"navi24", "RDNA2", "Radeon RX 6400"},
        {"vangogh", "RDNA2", "Steam Deck"},
        {"rembrandt", "RDNA2", "Ryzen 6000"},
        {"gfx1100", "RDNA3", "Radeon RX 7900"},
        {"navi31", "RDNA3", "Radeon RX 7900"},
        {"navi32", "RDNA3", "Radeon RX 7800"},
        {"navi33", "RDNA3", "Radeon RX 7600"},
        {"gfx1150", "RDNA3.5", "Ryzen AI 300"},
        {"gfx1200", "RDNA4", "Radeon RX 9060"},
        {"gfx1201", "RDNA4", "Radeon RX 9070"},
        {"maxwell", "Maxwell", "GeForce GTX 980 Ti", Maker::nvidia, "120"},
        {"pascal", "Pascal", "GeForce GTX 1080", Maker::nvidia, "134"},
        {"volta", "Volta", "Titan V", Maker::nvidia, "140"},
        {"turing", "Turing", "GeForce RTX 2080", Maker::nvidia, "164"},
        {"ampere", "Ampere", "GeForce RTX 3070", Maker::nvidia, "174"},
    };
    return kChips;
}

Result<std::vector<Chip>> chips_named(const std::vector<std::string>& names) {
    std::vector<Chip> found;
    for (std::string name : names) {
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
        const auto is_it = [&](const Chip& chip) { return chip.name == name; };
        const auto chip = std::find_if(chips().begin(), chips().end(), is_it);
        if (chip == chips().end()) {
            if (name == "list")
                return fail(Fault::usage, "--gpu list stands alone, without chips",
                            "ask it first: gobo cost --gpu list");
            std::vector<std::string> known;
            if (names.size() == 1) known.emplace_back("list");  // which stands alone
            for (const Chip& each : chips()) known.emplace_back(each.name);
            return fail(Fault::usage, fmt::format("unknown GPU '{}'", name), suggestion(name, known));
        }
        if (std::none_of(found.begin(), found.end(), is_it)) found.push_back(*chip);
    }
    return found;
}

std::string_view install_driver(Maker maker) {
    return maker == Maker::amd
               ? "install Mesa's Vulkan driver: apt-get install mesa-vulkan-drivers"
               : "install Mesa's NVK and what stands in for a GPU, from Debian 13 on: apt-get install "
                 "mesa-vulkan-drivers mesa-drm-shim; or fetch them into a folder with tools/fetch_mesa.sh "
                 "(installed: share/gobo/tools) "
                 "and name it with --driver";
}

std::string_view install_newer(const Chip& chip) {
    if (chip.name == "gfx1100") return "newer drivers know it as navi31: write --gpu navi31";
    return chip.maker == Maker::amd
               ? "a newer mesa-vulkan-drivers may know it: fetch one into a folder with tools/fetch_mesa.sh "
                 "(installed: share/gobo/tools) "
                 "and name it with --driver; 'gobo cost --gpu list' says which chips this one knows"
               : install_driver(chip.maker);
}

}  // namespace gobo::cost
