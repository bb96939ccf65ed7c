#include "lab/evaluate/eval_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "core/text.hpp"
#include "core/toml_depth.hpp"
#include "lab/evaluate/functions.hpp"

namespace gobo::evaluate {
namespace {

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
            report(error.source(), std::string(error.description()));
            return tl::unexpected(diagnostics_);
        }
        const std::map<std::string_view, std::map<std::string, EvalValue>*> sections = {
            {"inputs", &inputs_.inputs}, {"uniforms", &inputs_.uniforms}, {"samplers", &inputs_.samplers}};
        for (const auto& [key, node] : file) {
            if (const auto section = sections.find(key.str()); section != sections.end())
                read_section(node, "", *section->second);
            else if (key == "stage")
                read_stage(node);
            else
                report(key.source(), fmt::format("'{}' means nothing here", key.str()),
                       suggestion(key.str(), {"stage", "inputs", "uniforms", "samplers"}));
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

void match(const std::map<std::string, EvalValue>& values, const std::vector<Port>& ports, const char* what,
           Invocations& invocations, Diagnostics& diagnostics) {
    for (const auto& [name, value] : values) {
        const Port* const port = find_port(ports, name);
        if (port == nullptr) {
            diagnostics.push_back(fault(value, fmt::format("the stage has no {} '{}'", what, name),
                                        ports.empty() ? std::string() : suggestion(name, names_of(ports))));
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
            if (const auto depth = texels_.find(port.name); depth != texels_.end())
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
        else if (axis != kAlong.end())
            read_texel(name, value,
                       colors_[port->name].along[static_cast<std::size_t>(axis - kAlong.begin())]);
        else
            report(value, fmt::format("a sampler has no '{}'", member),
                   suggestion(member, {"color", "along_x", "along_y", "along_z", "size", "depths"}));
    }

    void report(const EvalValue& value, std::string message, std::string help = {}) {
        diagnostics_.push_back(fault(value, std::move(message), std::move(help)));
    }

    void read_texel(const std::string& name, const EvalValue& value, std::array<double, 4>& texel) {
        if (value.numbers.empty() || value.numbers.size() > 4)
            report(value, fmt::format("'{}' takes one to four numbers", name));
        std::copy_n(value.numbers.begin(), std::min<std::size_t>(value.numbers.size(), 4), texel.begin());
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

/// The shortest decimal that reads back the same, as TOML writes it; infinities and NaN by name.
std::string number_text(double number, Digits digits) {
    const auto as_float = static_cast<float>(number);
    const bool is_float = digits == Digits::of_float && static_cast<double>(as_float) == number;
    return is_float ? fmt::format("{}", as_float) : fmt::format("{}", number);
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

Result<EvalInputs> read_eval_inputs(std::string_view text, const std::string& path) {
    return FileReader(text, path).read();
}

Result<Invocations> invocations_of(const EvalInputs& inputs, const Program& program) {
    Invocations invocations;
    Diagnostics diagnostics;
    match(inputs.inputs, program.inputs, "input", invocations, diagnostics);
    match(inputs.uniforms, program.uniforms, "uniform", invocations, diagnostics);
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
    EvalPoint point{
        values_of(program.inputs, invocations, index), values_of(program.uniforms, invocations, index), {}};
    for (const ImagePort& port : program.images)
        if (const auto given = invocations.images.find(port.name); given != invocations.images.end())
            add_numbers(port.name, content_of(given->second, port, index), point.samplers);
    return point;
}

std::string eval_file(std::string_view stage, const EvalPoint& point, const std::vector<std::string>& comment,
                      Digits digits) {
    std::string text;
    for (const std::string& line : comment) text += fmt::format("# {}\n", one_line(line));
    return text + fmt::format("stage = \"{}\"\n{}{}{}", stage, table_text("inputs", point.inputs, digits),
                              table_text("uniforms", point.uniforms, digits),
                              table_text("samplers", point.samplers, digits));
}

}  // namespace gobo::evaluate
