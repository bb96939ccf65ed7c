#include "lab/evaluate/evaluate.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/half.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/scheduler.hpp"

namespace gobo::evaluate {
namespace {

#if defined(__SSE2__)
constexpr bool kCanFlush = true;
constexpr std::uint64_t kFlush = 0x8040;  // flush to zero, denormals are zero
std::uint64_t control() {
    return _mm_getcsr();
}
void set_control(std::uint64_t bits) {
    _mm_setcsr(static_cast<unsigned>(bits));
}
#elif defined(__aarch64__)
constexpr bool kCanFlush = true;
constexpr std::uint64_t kFlush = 1U << 24U;  // FPCR.FZ
std::uint64_t control() {
    std::uint64_t bits = 0;
    asm volatile("mrs %0, fpcr" : "=r"(bits));
    return bits;
}
void set_control(std::uint64_t bits) {
    asm volatile("msr fpcr, %0" : : "r"(bits));
}
#else
constexpr bool kCanFlush = false;
constexpr std::uint64_t kFlush = 0;
std::uint64_t control() {
    return 0;
}
void set_control(std::uint64_t /*bits*/) {}
#endif

/// While it lives, this thread takes denormal operands and results as 0 if `flush`, and keeps them otherwise.
class DenormalMode {
  public:
    explicit DenormalMode(bool flush) : saved_(control()) {
        set_control(flush ? saved_ | kFlush : saved_ & ~kFlush);
    }
    DenormalMode(const DenormalMode&) = delete;
    DenormalMode& operator=(const DenormalMode&) = delete;
    ~DenormalMode() { set_control(saved_); }

  private:
    std::uint64_t saved_;
};

/// The values of one input or uniform.
struct Binding {
    const Port* port = nullptr;
    std::vector<double> values;
    bool is_per_invocation = false;  ///< otherwise the same for all
};

/// Bindings in the order in which they overrule one another. Errors: names that the stage does not have, and
/// wrong numbers of values.
Result<std::vector<Binding>> bind(const Program& program, const Invocations& invocations) {
    std::vector<Binding> bindings;
    for (const auto& [name, bytes] : invocations.blocks) {
        const auto& blocks = program.uniform_blocks;
        const auto found = std::ranges::find(blocks, name, &UniformBlock::name);
        if (found == blocks.end())
            return fail(Fault::input, fmt::format("the stage has no uniform block '{}'", name),
                        suggestion(name, names_of(blocks)));
        for (const Port& port : program.uniforms)
            if (port.block == found - blocks.begin())
                bindings.push_back({&port, numbers_in_block(port, bytes), false});
    }
    for (const auto& [name, values] : invocations.values) {
        const Port* port = find_port(program.inputs, name);
        if (port == nullptr) port = find_port(program.uniforms, name);
        if (port == nullptr)
            return fail(Fault::input, fmt::format("the stage has no input or uniform '{}'", name),
                        suggestion(name, names_of(program.inputs, program.uniforms)));
        const std::size_t for_each = port->components * invocations.count;
        if (values.size() != port->components && values.size() != for_each)
            return fail(
                Fault::input,
                fmt::format("'{}' is a {}: it takes {} numbers, or {} for {} invocations, not {}", name,
                            port->type, port->components, for_each, invocations.count, values.size()));
        bindings.push_back({port, values, values.size() == for_each && invocations.count > 1});
    }
    return bindings;
}

/// The double that the shortest decimal of a float stands for: 0.1f is 0.1.
double shortest_decimal(float value) {
    if (!std::isfinite(value)) return static_cast<double>(value);
    std::array<char, 64> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
    double decimal = 0;
    std::from_chars(text.data(), written.ptr, decimal);
    return decimal;
}

/// What the lane of a row holds.
template <class T>
double number_in(const T* row, Scalar scalar, std::size_t lane) {
    if (is_float(scalar)) return static_cast<double>(row[lane]);
    const Int<T> integer = reinterpret_cast<const Int<T>*>(row)[lane];
    switch (scalar) {
        case Scalar::uint32:
            return to_unsigned(integer);
        case Scalar::int64:
            return static_cast<double>(integer);
        case Scalar::uint64:
            return static_cast<double>(static_cast<std::uint64_t>(integer));
        default:
            return to_signed(integer);
    }
}

/// A whole number as rows hold it. Clamped before it is converted: what does not fit would be undefined.
template <class I>
I integer_of(double value, Scalar scalar) {
    if (scalar == Scalar::uint64)
        return static_cast<I>(static_cast<std::uint64_t>(std::clamp(value, 0.0, 18446744073709549568.0)));
    if (scalar == Scalar::int64)
        return static_cast<I>(std::clamp(value, -9223372036854775808.0, 9223372036854774784.0));
    const auto whole = static_cast<std::int64_t>(std::clamp(value, -2147483648.0, 4294967295.0));
    return wrapped(static_cast<I>(to_signed(whole)), scalar);
}

double number_of_bits(std::uint64_t bits, Scalar scalar) {
    switch (scalar) {
        case Scalar::float32:
            return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        case Scalar::float64:
            return std::bit_cast<double>(bits);
        case Scalar::float16:
            return Half::unpack(static_cast<std::uint32_t>(bits));
        case Scalar::int32:
            return to_signed(bits);
        case Scalar::int64:
            return static_cast<double>(static_cast<std::int64_t>(bits));
        default:
            return static_cast<double>(wrapped(static_cast<std::int64_t>(bits), scalar));
    }
}

/// One call of run(): fills rows from values, runs batch after batch, reads rows back.
template <class T>
class Evaluation {
  public:
    Evaluation(const Program& program, const Invocations& invocations, const Options& options,
               Observer<T>* observer)
        : program_(program),
          invocations_(invocations),
          options_(options),
          observer_(observer),
          registers_(program, invocations.images),
          scheduler_(program, registers_, options, observer) {}

    Result<Outputs> run(const std::vector<Binding>& bindings) {
        prepare();
        if (invocations_.count == 0) return std::move(outputs_);
        fill_constants();
        for (const Binding& binding : bindings)
            if (!binding.is_per_invocation) fill(binding, 0);
        for (std::size_t first = 0; first < invocations_.count; first += kLanes) {
            begin_batch(first);
            for (const Binding& binding : bindings)
                if (binding.is_per_invocation || binding.port->is_written) fill(binding, first);
            if (const std::optional<Diagnostic> error = scheduler_.run()) return fail(*error);
            if (registers_.missing_image() >= 0) return fail(missing_image());
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
        for (const Port& port : program_.uniforms)
            if (port.is_written) outputs_.values[port.name].assign(port.components * invocations_.count, 0.0);
    }

    void fill_constants() {
        for (const ConstantSlot& constant : program_.constants) {
            if (is_float(constant.scalar))
                std::fill_n(registers_.floats(constant.slot), kLanes, float_constant(constant));
            else
                std::fill_n(registers_.ints(constant.slot), kLanes, integer_constant(constant));
        }
    }

    /// What is mediump, for the invocations from `first` on.
    void fill_half_constants(std::size_t first) {
        for (std::size_t i = 0; i < program_.constants.size(); ++i)
            for (std::size_t lane = 0; lane < kLanes && program_.constants[i].is_relaxed; ++lane)
                registers_.floats(program_.constants[i].slot)[lane] =
                    static_cast<T>(rounded_to_half(std::bit_cast<float>(program_.constants[i].bits),
                                                   small_halves(options_, i, first + lane)));
    }

    [[nodiscard]] T float_constant(const ConstantSlot& constant) const {
        if (constant.scalar == Scalar::float64)
            return static_cast<T>(std::bit_cast<double>(std::uint64_t{constant.high} << 32U | constant.bits));
        if (constant.scalar == Scalar::float16) return static_cast<T>(Half::unpack(constant.bits & 0xffffU));
        const float value = std::bit_cast<float>(constant.bits);
        const bool is_exact = sizeof(T) == 4 || options_.is_single;
        return is_exact ? static_cast<T>(value) : static_cast<T>(shortest_decimal(value));
    }
    [[nodiscard]] static Int<T> integer_constant(const ConstantSlot& constant) {
        if (is_wide(constant.scalar))
            return static_cast<Int<T>>(std::uint64_t{constant.high} << 32U | constant.bits);
        return wrapped(static_cast<Int<T>>(to_signed(constant.bits)), constant.scalar);
    }

    void begin_batch(std::size_t first) {
        for (const auto& [slot, count] : program_.variables)
            std::fill_n(registers_.ints(slot), count * kLanes, Int<T>{0});
        for (const Port& port : program_.uniforms)
            if (port.is_written) std::fill_n(registers_.ints(port.slot), port.components * kLanes, Int<T>{0});
        registers_.first_invocation = first;
        if (options_.is_half) fill_half_constants(first);
        if (observer_ != nullptr) observer_->begins(first);
        registers_.callers_lanes = lanes_where([&](std::size_t lane) {
            const std::size_t at = first + lane;
            return at < invocations_.count &&
                   (at >= invocations_.helpers.size() || !invocations_.helpers[at]);
        });
    }

    /// Lanes beyond the last invocation repeat it, so that they part from no others.
    void fill(const Binding& binding, std::size_t first) {
        const Scalar scalar = binding.port->scalar;
        const std::size_t stride = binding.is_per_invocation ? invocations_.count : 1;
        const std::size_t last = binding.is_per_invocation ? invocations_.count - 1 : 0;
        for (std::uint32_t component = 0; component < binding.port->components; ++component) {
            const double* values = binding.values.data() + component * stride;
            T* floats = registers_.floats(binding.port->slot + component);
            Int<T>* ints = registers_.ints(binding.port->slot + component);
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const double value = values[std::min(first + lane, last)];
                if (is_float(scalar))
                    floats[lane] = fitted(value, scalar);
                else if (scalar == Scalar::boolean)
                    ints[lane] = value != 0 ? 1 : 0;
                else
                    ints[lane] = integer_of<Int<T>>(value, scalar);
            }
        }
    }

    /// A number as the type and the arithmetic hold it.
    [[nodiscard]] T fitted(double value, Scalar scalar) const {
        const bool is_single = sizeof(T) == 4 || options_.is_single;
        if (scalar == Scalar::float64 || !is_single) return static_cast<T>(value);
        const auto single = static_cast<float>(value);
        return static_cast<T>(scalar == Scalar::float16 ? rounded_to_half(single) : single);
    }

    void read_batch(std::size_t first) {
        const std::size_t lanes = std::min(kLanes, invocations_.count - first);
        for (const Port& port : program_.outputs) read_port(port, first, lanes);
        for (const Port& port : program_.uniforms)
            if (port.is_written) read_port(port, first, lanes);
        for (const WrittenTexel& written : registers_.take_written()) outputs_.written.push_back(written);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            outputs_.discarded[first + lane] = has_lane(scheduler_.discarded(), lane);
            if (options_.count && has_lane(registers_.callers_lanes, lane))
                scheduler_.add_counts(lane, outputs_.counts[first + lane]);
        }
    }

    void read_port(const Port& port, std::size_t first, std::size_t lanes) {
        std::vector<double>& values = outputs_.values[port.name];
        for (std::uint32_t component = 0; component < port.components; ++component)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                values[component * invocations_.count + first + lane] =
                    number_in(registers_.floats(port.slot + component), port.scalar, lane);
    }

    [[nodiscard]] Diagnostic missing_image() {
        const auto index = static_cast<std::size_t>(registers_.missing_image());
        const std::string name = index < program_.images.size() ? program_.images[index].name : "?";
        return error_at({},
                        fmt::format("the stage reads the sampler '{}', for which no image is given", name));
    }

    const Program& program_;
    const Invocations& invocations_;
    const Options& options_;
    Observer<T>* observer_;
    Registers<T> registers_;
    Scheduler<T> scheduler_;
    Outputs outputs_;
};

}  // namespace

std::vector<double> numbers_in_block(const Port& port, const std::vector<std::byte>& bytes) {
    const std::size_t size = GlslType{port.scalar}.scalar_size();
    std::vector<double> numbers;
    for (const std::uint32_t offset : port.offsets) {
        std::uint64_t bits = 0;
        if (offset + size <= bytes.size()) std::memcpy(&bits, bytes.data() + offset, size);
        numbers.push_back(number_of_bits(bits, port.scalar));
    }
    return numbers;
}

template <class T>
Result<Outputs> run(const Program& program, const Invocations& invocations, const Options& options,
                    Observer<T>* observer) {
    if (options.flush_denormals && !kCanFlush)
        return fail(Fault::usage, "this processor cannot flush denormal numbers");
    if (program.has_wide && sizeof(T) == 4)
        return fail(Fault::internal, "numbers of 64 bits were evaluated in single precision");
    GOBO_TRY(const std::vector<Binding> bindings, bind(program, invocations));
    const DenormalMode mode(options.flush_denormals && sizeof(T) == 4);
    return Evaluation<T>(program, invocations, options, observer).run(bindings);
}

template Result<Outputs> run<float>(const Program&, const Invocations&, const Options&, Observer<float>*);
template Result<Outputs> run<double>(const Program&, const Invocations&, const Options&, Observer<double>*);

template <class T>
const Row& Step<T>::row() const {
    return row_of(program.operations[operation]);
}

template <class T>
std::string_view Step<T>::name() const {
    return row().name;
}

template <class T>
double Step<T>::value(const Slice& slice, std::uint32_t component, std::size_t lane) const {
    return number_in(rows + (std::size_t{slice.slot} + component) * kLanes, slice.scalar, lane);
}

template struct Step<float>;
template struct Step<double>;

}  // namespace gobo::evaluate
