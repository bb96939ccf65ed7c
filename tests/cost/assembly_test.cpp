// Assembly counted by kind of instruction.
#include <gtest/gtest.h>

#include "cost_support.hpp"
#include "lab/cost/nvidia_assembly.hpp"
#include "lab/cost/stage_cost.hpp"

namespace gobo::cost {
namespace {

TEST(Assembly, IsCountedByKind) {
    const ByKind kinds = count_kinds(
        "BB0:\n"
        "\tv_interp_p1_f32_e32 v2, v0, attr1.x                         ; c8080400\n"
        "\tv_mul_f32_e32 v0, v0, v1                                    ; 0a000300\n"
        "\tv_rsq_f32_e32 v9, v9                                        ; 7e124909\n"
        "\tv_mov_b32_e32 v5, 0                                         ; 7e0a0280\n"
        "\ts_andn2_b64 exec, s[8:9], exec                              ; 89fe7e08\n"
        "\ts_buffer_load_dwordx4 s[12:15], s[4:7], 0x40                ; c02a0302 00000040\n"
        "\timage_sample v[0:3], v3, s[8:15], s[0:3] dmask:0xf          ; f0800f00 00020003\n"
        "\ts_cbranch_execz BB4                                         ; bf880009\n"
        "BB4:\n"
        "\texp mrt0 v0, v0, v1, v1 done compr vm                       ; c4001c0f 80800100\n"
        "\ts_waitcnt lgkmcnt(0)                                        ; bf8cc07f\n"
        "\ts_endpgm                                                    ; bf810000\n");
    //                        arithmetic, transcendental, interpolation, move, scalar, memory, texture,
    //                        branch, output, wait
    EXPECT_EQ(kinds, (ByKind{1, 1, 1, 1, 1, 1, 1, 2, 1, 1}));
}

struct OccupancyRow {
    std::string name;
    std::string chip;
    std::uint64_t radv;
    std::uint64_t waves;
};
class Occupancy : public testing::TestWithParam<OccupancyRow> {};

TEST_P(Occupancy, IsNotAboveThePlacesOfASimd) {
    const CompiledStage stage{"fragment", 32, {{"Subgroups per SIMD", GetParam().radv}}, ""};
    EXPECT_EQ(cost_of(stage, chips_of({GetParam().chip}).front(), false).occupancy, GetParam().waves);
}

INSTANTIATE_TEST_SUITE_P(Rows, Occupancy,
                         testing::Values(OccupancyRow{"rdna1_of_few_registers", "navi10", 40, 20},
                                         OccupancyRow{"rdna2_of_few_registers", "navi21", 32, 16},
                                         OccupancyRow{"rdna2_of_most_registers", "navi21", 4, 4},
                                         OccupancyRow{"gcn_of_few_registers", "vega10", 10, 10}),
                         [](const auto& row) { return row.param.name; });

TEST(Assembly, HasALoopWhereItBranchesBack) {
    EXPECT_FALSE(branches_back("BB0:\n\ts_cbranch_scc0 BB2\nBB1:\n\ts_branch BB2\nBB2:\n\ts_endpgm\n"));
    EXPECT_TRUE(branches_back(
        "BB0:\n\ts_nop 0\nBB1:\n\ts_cbranch_scc1 BB3\nBB2:\n\ts_branch BB1 ; bf82ffe9\nBB3:\n"));
    EXPECT_TRUE(branches_back("BB0:\nBB1:\n\ts_cbranch_scc1 BB1\n"));
}

/// As NVK prints: two blocks of which the second is a loop.
const char* const kNvidia =
    "==== NAK assembly\n"
    "block.u 0 L1 [] -> {\n"
    "      r0      = ipa.pass a[0x7c] rZ                // delay=6 wr:0\n"
    "      r0      = mufu.rcp r0                        // delay=1 wt=000001 wr:0\n"
    "      r1..3   = ldc.b64 c[0x1][+0x100]             // delay=6 wr:1\n"
    "      ur3     = ldc.b32 c[0x1][+0x104]             // delay=12 wr:0\n"
    "      ur1     = iadd3 ur3 0x1 rZ                   // delay=2\n"
    "} -> [1]\n"
    "block 1 L2 [0, 1] -> {\n"
    "      r1      = ffma.ftz r1 r0 r2                  // delay=4\n"
    "      r2      = fmnmx.ftz r1 rZ pF                 // delay=4\n"
    "      r3      = mov 0x10                           // delay=1\n"
    "      r3      = tex.b32 r1 r2                      // delay=1\n"
    "@!p0            bra L2                             // delay=1\n"
    "} -> [1, 2]\n"
    "block.u 2 L3 [1] -> {\n"
    "                exit                               // delay=1\n"
    "} -> []\n\n";

TEST(NvidiaAssembly, IsCountedByKind) {
    const NvidiaCode code = read_nvidia_assembly(kNvidia, "Ampere");
    //                        arithmetic, transcendental, interpolation, move, scalar, memory, texture,
    //                        branch, output, wait
    EXPECT_EQ(code.kinds, (ByKind{2, 1, 1, 1, 1, 2, 1, 2, 0, 0}));
    EXPECT_EQ(code.latency, 39U);
    EXPECT_EQ(code.uniform_registers, 4U);
    EXPECT_TRUE(code.has_loop);
    // Eleven are issued; two of the slow units take 32 / 4 cycles each.
    EXPECT_EQ(code.cycles, 16U);
    EXPECT_EQ(read_nvidia_assembly(kNvidia, "Pascal").cycles, 11U) << "whose slow units take 32 / 8";
}

TEST(NvidiaAssembly, HasNoLoopWhereBlocksFollowEachOther) {
    EXPECT_FALSE(
        read_nvidia_assembly("block 0 L1 [] -> {\n} -> [1, 2]\nblock 1 L2 [0] -> {\n} -> [2]\n", "Ampere")
            .has_loop);
}

TEST(NvidiaAssembly, KeepsAsManyWarpsAsItsRegistersAllow) {
    EXPECT_EQ(nvidia_occupancy(16, "Ampere"), 12U);
    EXPECT_EQ(nvidia_occupancy(46, "Ampere"), 10U);
    EXPECT_EQ(nvidia_occupancy(255, "Ampere"), 2U);
    EXPECT_EQ(nvidia_occupancy(40, "Turing"), 8U);
}

}  // namespace
}  // namespace gobo::cost
