#include "lab/evaluate/eval_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "core/text.hpp"
#include "core/toml_depth.hpp"
#include "core/toml_repeats.hpp"
#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/image_call.hpp"

namespace gobo::evaluate {
namespace {

constexpr std::uint32_t kLargestIndex = 65535;

/// Reads the file; every fault is added to `diagnostics`.
class FileReader {
  public:
    FileReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

    Result<EvalInputs> read() {
        if (const int line = line_of_overlong_key(text_); line > 0)
            return fail({path_, line, 0}, "", fmt::format("a key has more than {} parts", kMostKeyParts),
                        "nest fewer tables");
        toml::table file;
        try {
            file = toml::parse(text_, path_);
        } catch (const toml::parse_error& error) {
            const toml::source_position at = error.source().begin;
            const auto repeated = repeated_key(error.description(), text_, at.line, at.column);
            report(error.source(), repeated.value_or(std::string(error.description())));
            return tl::unexpected(diagnostics_);
        }
        const std::map<std::string_view, std::map<std::string, EvalValue>*> sections = {
            {"inputs", &inputs_.inputs}, {"uniforms", &inputs_.uniforms}, {"samplers", &inputs_.samplers}};
        for (const auto& [key, node] : file) {
            if (const auto section = sections.find(key.str()); section != sections.end())
                read_section(node, "", *section->second);
            else if (key == "stage")
                read_stage(node);
            else if (key == "pixel")
                read_pixel(node);
            else if (key == "machine")
                read_machine(key.source(), node);
            else
                report(
                    key.source(), fmt::format("'{}' means nothing here", key.str()),
                    suggestion(key.str(), {"stage", "machine", "pixel", "inputs", "uniforms", "samplers"}));
        }
        if (!diagnostics_.empty()) return tl::unexpected(diagnostics_);
        return std::move(inputs_);
    }

  private:
    void report(const toml::source_region& source, std::string message, std::string help = {}) {
        diagnostics_.push_back(error_at(place_of(source), std::move(message), std::move(help)));
        diagnostics_.back().quoted_line = line_of(text_, diagnostics_.back().place.line);
    }

    [[nodiscard]] Place place_of(const toml::source_region& source) const {
        return {path_, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
    }

    void read_stage(const toml::node& node) {
        inputs_.stage = node.value_or(std::string());
        if (inputs_.stage != "vertex" && inputs_.stage != "fragment")
            report(node.source(), "'stage' is neither \"vertex\" nor \"fragment\"");
    }

    void read_pixel(const toml::node& node) {
        const std::int64_t pixel = node.value_or(std::int64_t{-1});
        if (!node.is_integer() || pixel < 0 || pixel > 3)
            return report(node.source(), "'pixel' is not one of the quad's: 0, 1, 2 or 3");
        inputs_.pixel = static_cast<std::size_t>(pixel);
    }

    void read_machine(const toml::source_region& source, const toml::node& node) {
        inputs_.machine = {{}, place_of(source), {}};
        inputs_.machine.quoted_line = line_of(text_, inputs_.machine.place.line);
        inputs_.machine.text = node.value_or(std::string());
        if (!node.is_string())
            report(node.source(), "'machine' names a variant of arithmetic: machine = \"flushed\"");
    }

    void read_section(const toml::node& section, const std::string& prefix,
                      std::map<std::string, EvalValue>& values) {
        const toml::table* const table = section.as_table();
        if (table == nullptr)
            return report(section.source(), "this is a table of names and values",
                          "write it as a section: [inputs]");
        for (const auto& [key, node] : *table) {
            const std::string name = prefix + std::string(key.str());
            if (node.is_table()) {
                read_section(node, name + ".", values);
                continue;
            }
            EvalValue value{{}, place_of(key.source()), {}};
            value.quoted_line = line_of(text_, value.place.line);
            if (!read_numbers(node, value.numbers))
                report(node.source(),
                       fmt::format("'{}' is not a number, a boolean or an array of these", name));
            values[name] = std::move(value);
        }
    }

    static bool read_numbers(const toml::node& node, std::vector<double>& numbers) {
        if (const toml::array* array = node.as_array())
            return std::all_of(array->begin(), array->end(),
                               [&](const toml::node& element) { return read_numbers(element, numbers); });
        if (const auto truth = node.as_boolean())
            numbers.push_back(truth->get() ? 1.0 : 0.0);
        else if (const auto whole = node.as_integer())
            numbers.push_back(static_cast<double>(whole->get()));
        else if (const auto real = node.as_floating_point())
            numbers.push_back(real->get());
        else
            return false;
        return true;
    }

    std::string_view text_;
    const std::string& path_;
    EvalInputs inputs_;
    Diagnostics diagnostics_;
};

Diagnostic fault(const EvalValue& value, std::string message, std::string help = {}) {
    Diagnostic diagnostic = error_at(value.place, std::move(message), std::move(help));
    diagnostic.quoted_line = value.quoted_line;
    return diagnostic;
}

/// Whether the value is one for each pixel of a quad.
bool is_of_quad(const EvalValue& value, const Port& port) {
    return value.numbers.size() == 4 * port.components;
}

void match(const std::map<std::string, EvalValue>& values, const std::vector<Port>& ports, const char* what,
           bool may_be_quad, Invocations& invocations, Diagnostics& diagnostics) {
    for (const auto& [name, value] : values) {
        const Port* const port = find_port(ports, name);
        if (port == nullptr) {
            diagnostics.push_back(fault(value, fmt::format("the stage has no {} '{}'", what, name),
                                        ports.empty() ? std::string() : suggestion(name, names_of(ports))));
        } else if (may_be_quad && is_of_quad(value, *port)) {
            std::vector<double>& numbers = invocations.values[name];
            for (std::uint32_t component = 0; component < port->components; ++component)
                for (std::size_t pixel = 0; pixel < 4; ++pixel)
                    numbers.push_back(value.numbers[pixel * port->components + component]);
            invocations.count = 4;
        } else if (value.numbers.size() != port->components) {
            diagnostics.push_back(
                fault(value, fmt::format("'{}' is a {}: it takes {} numbers, not {}", name, port->type,
                                         port->components, value.numbers.size())));
        } else {
            invocations.values[name] = value.numbers;
        }
    }
}

/// Reads the textures: what the file calls "map", or "map.color" and so on, for each sampler.
class SamplerMatcher {
  public:
    SamplerMatcher(const EvalInputs& inputs, const Program& program, Diagnostics& diagnostics)
        : inputs_(inputs), program_(program), diagnostics_(diagnostics) {}

    void add_to(Invocations& invocations) {
        for (const auto& [name, value] : inputs_.samplers) read(name, value);
        if (diagnostics_.empty())
            for (const auto& [name, texels] : texels_) check(name, texels);
        for (const ImagePort& port : program_.images) {
            if (const auto pattern = patterns_.find(port.name);
                pattern != patterns_.end() && !pattern->second.colors.empty())
                invocations.images[port.name] =
                    PatternImage{std::make_shared<std::vector<TexelPattern>>(1, pattern->second), 4,
                                 port.type.dimension == spv::DimCube};
            else if (const auto depth = texels_.find(port.name); depth != texels_.end())
                invocations.images[port.name] = image_of(depth->second, port.type);
            else if (const auto color = colors_.find(port.name); color != colors_.end())
                invocations.images[port.name] = image_of(color->second, port.type);
        }
    }

  private:
    void read(const std::string& name, const EvalValue& value) {
        const auto port = std::ranges::find_if(program_.images, [&](const ImagePort& one) {
            return name == one.name || name.starts_with(one.name + ".");
        });
        if (port == program_.images.end())
            return report(value, fmt::format("the stage has no sampler '{}'", name));
        const std::string member = name.substr(std::min(port->name.size() + 1, name.size()));
        const auto axis = std::ranges::find(kAlong, member);
        if (member.empty() || member == "color")
            read_texel(name, value, colors_[port->name].color);
        else if (member == "size")
            read_size(name, value, texels_[port->name]);
        else if (member == "depths")
            texels_[port->name].depths = value.numbers;
        else if (member == "texels")
            read_texels(name, value, patterns_[port->name]);
        else if (member == "seed")
            read_whole(name, value, patterns_[port->name].seed);
        else if (member == "side")
            read_whole(name, value, patterns_[port->name].side);
        else if (member == "levels")
            read_whole(name, value, patterns_[port->name].levels);
        else if (axis != kAlong.end())
            read_texel(name, value,
                       colors_[port->name].along[static_cast<std::size_t>(axis - kAlong.begin())]);
        else
            report(value, fmt::format("a sampler has no '{}'", member),
                   suggestion(member, {"color", "along_x", "along_y", "along_z", "size", "depths", "texels",
                                       "seed", "side", "levels"}));
    }

    void report(const EvalValue& value, std::string message, std::string help = {}) {
        diagnostics_.push_back(fault(value, std::move(message), std::move(help)));
    }

    void read_texel(const std::string& name, const EvalValue& value, std::array<double, 4>& texel) {
        if (value.numbers.empty() || value.numbers.size() > 4)
            report(value, fmt::format("'{}' takes one to four numbers", name));
        std::copy_n(value.numbers.begin(), std::min<std::size_t>(value.numbers.size(), 4), texel.begin());
    }

    void read_texels(const std::string& name, const EvalValue& value, TexelPattern& pattern) {
        if (value.numbers.empty() || value.numbers.size() % 4 != 0)
            return report(value, fmt::format("'{}' takes four numbers for each colour", name));
        for (std::size_t at = 0; at < value.numbers.size(); at += 4)
            std::copy_n(value.numbers.begin() + static_cast<std::ptrdiff_t>(at), 4,
                        pattern.colors.emplace_back().begin());
    }

    void read_whole(const std::string& name, const EvalValue& value, int& number) {
        if (value.numbers.size() != 1 || !(value.numbers[0] >= 0) || value.numbers[0] > kMostTexels ||
            value.numbers[0] != std::floor(value.numbers[0]))
            return report(value, fmt::format("'{}' takes a whole number from 0 to {}", name, kMostTexels));
        number = static_cast<int>(value.numbers[0]);
    }

    void read_size(const std::string& name, const EvalValue& value, DepthTexels& texels) {
        const std::vector<double>& numbers = value.numbers;
        const bool are_extents = std::ranges::all_of(numbers, [](double number) {
            return number >= 1 && number <= kMostTexels && number == std::floor(number);
        });
        if (!are_extents || numbers.size() < 2 || numbers.size() > 3)
            return report(
                value, fmt::format("'{}' takes the numbers of columns, rows and, of an array, layers", name));
        texels.width = static_cast<int>(numbers[0]);
        texels.height = static_cast<int>(numbers[1]);
        texels.layers = numbers.size() > 2 ? static_cast<int>(numbers[2]) : 1;
    }

    /// Every depth is there.
    void check(const std::string& name, const DepthTexels& texels) {
        const double count = static_cast<double>(texels.width) * texels.height * texels.layers;
        if (static_cast<double>(texels.depths.size()) == count) return;
        const bool has_depths = inputs_.samplers.contains(name + ".depths");
        report(
            inputs_.samplers.at(name + (has_depths ? ".depths" : ".size")),
            fmt::format("'{}' has {} depths where its size asks for {}", name, texels.depths.size(), count));
    }

    static constexpr std::array<std::string_view, 3> kAlong = {"along_x", "along_y", "along_z"};
    static constexpr double kMostTexels = 1 << 14;  ///< along a side

    const EvalInputs& inputs_;
    const Program& program_;
    Diagnostics& diagnostics_;
    std::map<std::string, EvenColor> colors_;
    std::map<std::string, DepthTexels> texels_;
    std::map<std::string, TexelPattern> patterns_;
};

using Numbers = std::map<std::string, std::vector<double>>;

Numbers values_of(const std::vector<Port>& ports, const Invocations& invocations, std::size_t index) {
    Numbers result;
    for (const Port& port : ports) {
        const auto found = invocations.values.find(port.name);
        if (found == invocations.values.end()) continue;
        const bool is_common = found->second.size() == port.components;
        for (std::size_t component = 0; component < port.components; ++component)
            result[port.name].push_back(
                found->second[is_common ? component : component * invocations.count + index]);
    }
    return result;
}

/// Inputs of the four pixels of the quad around `index`; those that are the same in all of them once.
Numbers values_of_quad(const std::vector<Port>& ports, const Invocations& invocations, std::size_t index) {
    Numbers result;
    const std::size_t first = index - index % 4;
    for (std::size_t pixel = first; pixel < first + 4; ++pixel)
        for (const auto& [name, numbers] : values_of(ports, invocations, pixel))
            result[name].insert(result[name].end(), numbers.begin(), numbers.end());
    for (auto& [name, numbers] : result) {
        const std::size_t components = numbers.size() / 4;
        bool is_common = true;
        for (std::size_t i = components; i < numbers.size(); ++i)
            is_common = is_common && numbers[i] == numbers[i - components] &&
                        std::signbit(numbers[i]) == std::signbit(numbers[i - components]);
        if (is_common) numbers.resize(components);
    }
    return result;
}

std::string table_text(std::string_view name, const Numbers& values, Digits digits) {
    if (values.empty()) return {};
    std::string text = fmt::format("\n[{}]\n", name);
    for (const auto& [key, numbers] : values) {
        std::vector<std::string> texts;
        for (const double number : numbers) texts.push_back(number_text(number, digits));
        const std::string list = fmt::format("{}", fmt::join(texts, ", "));
        text += numbers.size() == 1 ? fmt::format("\"{}\" = {}\n", key, list)
                                    : fmt::format("\"{}\" = [{}]\n", key, list);
    }
    return text;
}

}  // namespace

std::string number_text(double number, Digits digits) {
    // The shortest decimal of a float need not be the whole number that an integer is.
    const bool is_whole = number == std::trunc(number) && std::abs(number) <= 0x1p32 && number != 0;
    if (is_whole) return fmt::format("{:.0f}", number);
    const auto as_float = static_cast<float>(number);
    const bool is_float = digits == Digits::of_float && static_cast<double>(as_float) == number;
    return is_float ? fmt::format("{}", as_float) : fmt::format("{}", number);
}

Result<EvalInputs> read_eval_inputs(std::string_view text, const std::string& path) {
    return FileReader(text, path).read();
}

std::uint32_t longest_array(const EvalInputs& inputs) {
    std::uint32_t longest = 0;
    for (const auto& [name, value] : inputs.uniforms)
        for (std::size_t at = name.find('['); at != std::string::npos; at = name.find('[', at + 1)) {
            std::uint32_t index = 0;
            std::from_chars(name.data() + at + 1, name.data() + name.size(), index);
            longest = std::max(longest, std::min(index, kLargestIndex) + 1);
        }
    return longest;
}

Result<Invocations> invocations_of(const EvalInputs& inputs, const Program& program) {
    Invocations invocations;
    Diagnostics diagnostics;
    match(inputs.inputs, program.inputs, "input", program.is_fragment, invocations, diagnostics);
    match(inputs.uniforms, program.uniforms, "uniform", false, invocations, diagnostics);
    SamplerMatcher(inputs, program, diagnostics).add_to(invocations);
    if (!diagnostics.empty()) return tl::unexpected(diagnostics);
    return invocations;
}

Diagnostics inputs_left_out(const EvalInputs& inputs, const Program& program) {
    Diagnostics notes;
    for (const Port& port : program.inputs) {
        if (inputs.inputs.contains(port.name) || port.name.starts_with("gl_")) continue;
        notes.push_back(
            error_at({}, fmt::format("the input '{}' ({}) is not given and is 0", port.name, port.type)));
        notes.back().severity = Severity::note;
    }
    return notes;
}

EvalPoint point_of(const Program& program, const Invocations& invocations, std::size_t index) {
    EvalPoint point;
    const bool in_quads = needs_quads(program) && invocations.count % 4 == 0;
    point.inputs = in_quads ? values_of_quad(program.inputs, invocations, index)
                            : values_of(program.inputs, invocations, index);
    point.pixel = in_quads ? index % 4 : 0;
    point.uniforms = values_of(program.uniforms, invocations, index);
    for (const ImagePort& port : program.images) {
        const auto given = invocations.images.find(port.name);
        if (given == invocations.images.end()) continue;
        if (const TexelPattern* const pattern = pattern_of(given->second, index))
            add_numbers(port.name, *pattern, point.samplers);
        else
            add_numbers(port.name, content_of(given->second, port, index), point.samplers);
    }
    return point;
}

std::string eval_file(std::string_view stage, const EvalPoint& point, const std::vector<std::string>& comment,
                      Digits digits) {
    std::string text;
    for (const std::string& line : comment) text += fmt::format("# {}\n", one_line(line));
    text += fmt::format("stage = \"{}\"\n", stage);
    if (!point.machine.empty()) text += fmt::format("machine = \"{}\"\n", point.machine);
    if (point.pixel != 0) text += fmt::format("pixel = {}  # of the quad's four\n", point.pixel);
    return text + fmt::format("{}{}{}", table_text("inputs", point.inputs, digits),
                              table_text("uniforms", point.uniforms, digits),
                              table_text("samplers", point.samplers, digits));
}

}  // namespace gobo::evaluate
