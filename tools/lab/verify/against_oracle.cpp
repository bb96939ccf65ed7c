#include "lab/verify/against_oracle.hpp"

#include "lab/verify/comparison.hpp"
#include "lab/verify/feed.hpp"

namespace gobo::verify {
namespace {

Result<bool> check(const evaluate::Program& program, Comparison comparison, std::span<const Sample> samples,
                   Marks& marks) {
    const Result<evaluate::Invocations> invocations = feed(program, samples);
    if (!invocations) return tl::unexpected(invocations.error());
    const Result<evaluate::Outputs> outputs = comparison.run(*invocations);
    if (!outputs) return tl::unexpected(outputs.error());
    for (std::size_t i = 0; i < samples.size(); ++i)
        (void)comparison.judge(samples[i], *invocations, *outputs, i, marks, i);
    return true;
}

}  // namespace

Result<StageReport> check_against_oracle(const evaluate::Program& program, StageKind stage,
                                         const oracle::Model& model, int count, std::uint64_t seed) {
    const std::vector<Sample> exact = make_samples(model, stage, count, seed);
    StageReport report;
    Marks marks(exact.size());
    const Result<bool> in_double =
        check(program, Comparison(program, stage, model, Precision::fp64, report), exact, marks);
    if (!in_double) return tl::unexpected(in_double.error());
    const Result<bool> in_float = check(program, Comparison(program, stage, model, Precision::fp32, report),
                                        rounded_to_float(exact), marks);
    if (!in_float) return tl::unexpected(in_float.error());
    verify::count(marks, report);
    return report;
}

}  // namespace gobo::verify
