#include "plain_shaders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lab/evaluate/images.hpp"

namespace gobo {
namespace {

std::vector<std::string> split_at(std::string_view text, std::string_view separator) {
    std::vector<std::string> parts;
    for (auto at = text.find(separator); at != std::string_view::npos; at = text.find(separator)) {
        parts.emplace_back(text.substr(0, at));
        text.remove_prefix(at + separator.size());
    }
    parts.emplace_back(text);
    return parts;
}

/// Calls use(number, text) for the lines that have the mark, with what stands behind it.
template <class Use>
void for_each_mark(const std::string& source, std::string_view mark, Use&& use) {
    const auto count = std::count(source.begin(), source.end(), '\n');
    for (int number = 1; number <= count; ++number) {
        const std::string_view line = line_of(source, number);
        const auto at = line.find(mark);
        if (at != std::string_view::npos) use(number, line.substr(at + mark.size()));
    }
}

/// "(0, 0, 1)" or "4".
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    if (text.starts_with('(')) text = text.substr(1, text.size() - 2);
    for (const std::string& number : split_at(text, ", "))
        numbers.push_back(std::strtod(number.c_str(), nullptr));
    return numbers;
}

/// "cosine = 1; levels = 4".
Inputs inputs_of(std::string_view text) {
    Inputs inputs;
    for (const std::string& input : split_at(text, "; ")) {
        const auto equals = input.find(" = ");
        EXPECT_NE(equals, std::string::npos) << input;
        if (equals != std::string::npos)
            inputs[input.substr(0, equals)] = numbers_of(std::string_view(input).substr(equals + 3));
    }
    return inputs;
}

/// "cosine = 1; levels = 4: 1, not 0.75".
WrongMark mark_of(int line, bool is_inexact, std::string_view text) {
    WrongMark mark{line, is_inexact, {}, {}, {}, {}};
    const auto colon = text.find(": ");
    const auto comma = text.rfind(", not ");
    EXPECT_TRUE(colon < comma && comma != std::string_view::npos) << text;
    if (colon >= comma || comma == std::string_view::npos) return mark;
    mark.at = text.substr(0, colon);
    mark.inputs = inputs_of(mark.at);
    mark.plain = text.substr(colon + 2, comma - colon - 2);
    mark.right = text.substr(comma + 6);
    return mark;
}

}  // namespace

Lines following_lines(const std::string& source) {
    Lines lines;
    for_each_mark(source, "// so: ", [&](int number, std::string_view text) {
        lines.insert(fmt::format("{}: {}", number, text));
    });
    return lines;
}

std::vector<WrongMark> wrong_marks(const std::string& source) {
    std::vector<WrongMark> marks;
    for_each_mark(source, "// wrong at ",
                  [&](int line, std::string_view text) { marks.push_back(mark_of(line, false, text)); });
    for_each_mark(source, "// inexact at ",
                  [&](int line, std::string_view text) { marks.push_back(mark_of(line, true, text)); });
    return marks;
}

std::string number_text(double number) {
    return std::isnan(number) ? "nan" : fmt::format("{:.6g}", number);  // a NaN's sign means nothing
}

double result_of(const std::string& path, const Inputs& inputs, bool is_double) {
    const evaluate::Program program = program_of_file(path);
    evaluate::Invocations invocations;
    for (const auto& [name, numbers] : inputs) invocations.values[name] = as_floats(numbers);
    for (const evaluate::ImagePort& image : program.images)
        if (const auto found = inputs.find(image.name); found != inputs.end())
            invocations.images[image.name] = [color = found->second](const evaluate::ImageRequest& request) {
                return evaluate::answer({color[0], color[1], color[2], color[3]}, request);
            };
    for (const auto& [name, image] : invocations.images) invocations.values.erase(name);
    const Result<evaluate::Outputs> outputs =
        is_double ? evaluate::run<double>(program, invocations) : evaluate::run<float>(program, invocations);
    EXPECT_TRUE(outputs) << path;
    return outputs ? outputs->values.at(program.outputs.front().name).front() : 0;
}

std::string subject_of(const std::string& source) {
    const std::string_view line = line_of(source, 2);
    return std::string(line.substr(line.find("// ") + 3));
}

bool shows(const std::string& source, const HardCase& hard) {
    const std::string subject = subject_of(source);
    const std::vector<std::string> names = split_at(subject.substr(0, subject.find(": ")), ", ");
    return std::find(names.begin(), names.end(), hard.name) != names.end();
}

}  // namespace gobo
