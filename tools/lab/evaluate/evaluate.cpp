#include "lab/evaluate/evaluate.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "lab/evaluate/bindings.hpp"
#include "lab/evaluate/denormals.hpp"
#include "lab/evaluate/loops.hpp"
#include "lab/evaluate/scheduler.hpp"

namespace gobo::evaluate {
namespace {

/// One call of run(): fills rows from values, runs batch after batch, reads rows back.
template <class T>
class Evaluation {
  public:
    Evaluation(const Program& program, const Invocations& invocations, const Options& options,
               Observer<T>* observer)
        : program_(program),
          invocations_(invocations),
          options_(options),
          machine_(program, invocations.images),
          scheduler_(program, machine_, options, observer) {}

    Result<Outputs> run(const std::vector<Binding>& bindings) {
        prepare();
        if (invocations_.count == 0) return std::move(outputs_);
        fill_constants();
        for (const Binding& binding : bindings)
            if (!binding.is_per_invocation) fill(binding, 0);
        for (std::size_t first = 0; first < invocations_.count; first += kLanes) {
            begin_batch(first);
            for (const Binding& binding : bindings)
                if (binding.is_per_invocation) fill(binding, first);
            if (const std::optional<Diagnostic> error = scheduler_.run()) return fail(*error);
            if (machine_.missing_image() >= 0) return fail(missing_image());
            read_batch(first);
        }
        return std::move(outputs_);
    }

  private:
    void prepare() {
        outputs_.count = invocations_.count;
        outputs_.discarded.assign(invocations_.count, false);
        if (options_.count) outputs_.counts.assign(invocations_.count, Counts{});
        for (const Port& port : program_.outputs)
            outputs_.values[port.name].assign(port.components * invocations_.count, 0.0);
    }

    void fill_constants() {
        for (const ConstantSlot& constant : program_.constants) {
            if (constant.scalar != Scalar::real) {
                std::fill_n(machine_.wholes(constant.slot), kLanes, to_signed(constant.bits));
                continue;
            }
            const float value = std::bit_cast<float>(constant.bits);
            const T in_arithmetic =
                sizeof(T) == 4 ? static_cast<T>(value) : static_cast<T>(shortest_decimal(value));
            std::fill_n(machine_.reals(constant.slot), kLanes, in_arithmetic);
        }
    }

    void begin_batch(std::size_t first) {
        for (const auto& [slot, count] : program_.variables)
            std::fill_n(machine_.wholes(slot), count * kLanes, Whole<T>{0});
        machine_.first_invocation = first;
        machine_.real = 0;
        for (std::size_t lane = 0; lane < kLanes && first + lane < invocations_.count; ++lane) {
            const bool is_helper =
                first + lane < invocations_.helpers.size() && invocations_.helpers[first + lane];
            if (!is_helper) machine_.real |= LaneMask{1} << lane;
        }
    }

    /// Lanes beyond the last invocation repeat it, so that they part from no others.
    void fill(const Binding& binding, std::size_t first) {
        const std::size_t last = invocations_.count - 1;
        for (std::uint32_t component = 0; component < binding.port->components; ++component) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const std::size_t at = binding.is_per_invocation
                                           ? component * invocations_.count + std::min(first + lane, last)
                                           : component;
                set_cell(*binding.port, component, lane, binding.values[at]);
            }
        }
    }

    void set_cell(const Port& port, std::uint32_t component, std::size_t lane, double value) {
        const std::uint32_t slot = port.slot + component;
        switch (port.scalar) {
            case Scalar::real:
                machine_.reals(slot)[lane] = static_cast<T>(value);
                break;
            case Scalar::boolean:
                machine_.wholes(slot)[lane] = value != 0 ? 1 : 0;
                break;
            default: {
                // Clamped first: a conversion of what does not fit would be undefined.
                const double fitting = std::clamp(value, -2147483648.0, 4294967295.0);
                machine_.wholes(slot)[lane] = to_signed(static_cast<std::int64_t>(fitting));
            }
        }
    }

    [[nodiscard]] double cell(const Port& port, std::uint32_t component, std::size_t lane) {
        const std::uint32_t slot = port.slot + component;
        if (port.scalar == Scalar::real) return static_cast<double>(machine_.reals(slot)[lane]);
        if (port.scalar == Scalar::unsigned_integer) return to_unsigned(machine_.wholes(slot)[lane]);
        return to_signed(machine_.wholes(slot)[lane]);
    }

    void read_batch(std::size_t first) {
        const std::size_t lanes = std::min(kLanes, invocations_.count - first);
        for (const Port& port : program_.outputs) {
            std::vector<double>& values = outputs_.values[port.name];
            for (std::uint32_t component = 0; component < port.components; ++component)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    values[component * invocations_.count + first + lane] = cell(port, component, lane);
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            outputs_.discarded[first + lane] = (scheduler_.discarded() >> lane & 1U) != 0;
            if (options_.count && (machine_.real >> lane & 1U) != 0)
                scheduler_.add_counts(lane, outputs_.counts[first + lane]);
        }
    }

    [[nodiscard]] Diagnostic missing_image() {
        const auto index = static_cast<std::size_t>(machine_.missing_image());
        const std::string name = index < program_.images.size() ? program_.images[index].name : "?";
        return error_at({},
                        fmt::format("the stage reads the sampler '{}', for which no image is given", name));
    }

    const Program& program_;
    const Invocations& invocations_;
    const Options& options_;
    Machine<T> machine_;
    Scheduler<T> scheduler_;
    Outputs outputs_;
};

}  // namespace

template <class T>
Result<Outputs> run(const Program& program, const Invocations& invocations, const Options& options,
                    Observer<T>* observer) {
    if (options.flush_denormals && !DenormalMode::is_supported())
        return fail(Fault::usage, "this machine cannot flush denormal numbers");
    const Result<std::vector<Binding>> bindings = bind(program, invocations);
    if (!bindings) return tl::unexpected(bindings.error());
    const DenormalMode mode(options.flush_denormals && sizeof(T) == 4);
    return Evaluation<T>(program, invocations, options, observer).run(*bindings);
}

template Result<Outputs> run<float>(const Program&, const Invocations&, const Options&, Observer<float>*);
template Result<Outputs> run<double>(const Program&, const Invocations&, const Options&, Observer<double>*);

template <class T>
std::string_view Step<T>::name() const {
    return instruction_table()[program.operations[operation].row].name;
}

template <class T>
double Step<T>::value(const Slice& slice, std::uint32_t component, std::size_t lane) const {
    const T* row = rows + (std::size_t{slice.slot} + component) * kLanes;
    if (slice.scalar == Scalar::real) return static_cast<double>(row[lane]);
    const Whole<T> whole = reinterpret_cast<const Whole<T>*>(row)[lane];
    return slice.scalar == Scalar::unsigned_integer ? to_unsigned(whole) : to_signed(whole);
}

template struct Step<float>;
template struct Step<double>;

}  // namespace gobo::evaluate
