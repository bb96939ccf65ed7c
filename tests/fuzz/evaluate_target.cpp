#include "lab/evaluate/evaluate.hpp"
#include "lab/evaluate/program.hpp"
#include "results.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

bool read_evaluate(std::string_view input) {
    const std::vector<std::uint32_t> words = words_of(input);
    const Result<evaluate::Program> program = evaluate::decode(words);
    if (!is_value(program)) return false;
    evaluate::Options options;
    options.iteration_limit = 16;
    return is_value(evaluate::run<float>(*program, {}, options));
}

}  // namespace gobo::fuzz
