#include "lab/sanitize/constant_value.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/numbers.hpp"

namespace gobo::sanitize {
namespace {

/// What 32 bits hold of a whole number.
double wrapped(std::int64_t number, Scalar scalar) {
    const auto bits = static_cast<std::uint32_t>(number);
    return scalar == Scalar::int32 ? static_cast<double>(static_cast<std::int32_t>(bits))
                                   : static_cast<double>(bits);
}

std::string text_of(const ConstantValue& value) {
    std::vector<std::string> texts;
    for (const double number : value.numbers)
        texts.push_back(std::isnan(number) ? "nan"
                        : value.is_float() ? fmt::format("{}", static_cast<float>(number))
                                           : fmt::format("{:.0f}", number));
    return texts.size() == 1 ? texts.front() : fmt::format("({})", fmt::join(texts, ", "));
}

bool is_plain(const Constant& value) {
    return value && value->elements == 0;
}

bool all_finite(const std::vector<Constant>& values) {
    return std::ranges::all_of(values, [](const Constant& value) {
        return std::ranges::all_of(value->numbers, [](double number) { return std::isfinite(number); });
    });
}

/// Tells of one operation at most once.
class Judge {
  public:
    Judge(std::string_view name, const std::vector<Constant>& operands, const ReportFault& report)
        : name_(name), operands_(operands), report_(report) {}

    void note(bool happens, std::string_view message) {
        if (happens && message_.empty()) message_ = message;
    }
    /// The result, after telling what is wrong with it. What is not finite already is no new cause.
    Constant finish(ConstantValue result) {
        if (!all_finite(operands_)) return result;
        if (result.is_float())
            for (double& number : result.numbers) {
                number = nearest_float(number);
                note(std::isnan(number), "a NaN made from finite numbers");
                note(std::isinf(number), "an infinity made from finite numbers");
            }
        if (message_.empty()) return result;
        std::vector<std::string> texts;
        for (const Constant& operand : operands_) texts.push_back(text_of(*operand));
        report_(message_, fmt::format("{} {} -> {}", name_, fmt::join(texts, ", "), text_of(result)));
        return result;
    }

  private:
    std::string_view name_;
    const std::vector<Constant>& operands_;
    const ReportFault& report_;
    std::string_view message_;
};

/// Component `i` of a value that a scalar among vectors is repeated for.
double at(const ConstantValue& value, std::size_t i) {
    return value.numbers.size() == 1 ? value.numbers.front() : value.numbers[i];
}

/// Operands of one type, a scalar beside vectors allowed; false where that cannot be.
bool bring_together(Constant& a, Constant& b) {
    if (!is_plain(a) || !is_plain(b)) return false;
    const auto rank = [](Scalar scalar) {
        return scalar == Scalar::float32 ? 2 : scalar == Scalar::uint32 ? 1 : 0;
    };
    if ((a->type.scalar == Scalar::boolean) != (b->type.scalar == Scalar::boolean)) return false;
    const Scalar scalar = rank(a->type.scalar) > rank(b->type.scalar) ? a->type.scalar : b->type.scalar;
    for (Constant* const value : {&a, &b}) {
        GlslType type = (*value)->type;
        type.scalar = scalar;
        *value = converted(*value, type);
    }
    return a->numbers.size() == b->numbers.size() || a->numbers.size() == 1 || b->numbers.size() == 1;
}

ConstantValue like(const ConstantValue& a, const ConstantValue& b) {
    return {a.numbers.size() >= b.numbers.size() ? a.type : b.type, 0, {}};
}

/// + - * / of floats.
Constant float_arithmetic(char operation, const ConstantValue& a, const ConstantValue& b,
                          const ReportFault& report) {
    const std::string_view name = operation == '+'   ? "FAdd"
                                  : operation == '-' ? "FSub"
                                  : operation == '*' ? "FMul"
                                                     : "FDiv";
    const std::vector<Constant> operands{a, b};
    Judge judge(name, operands, report);
    ConstantValue result = like(a, b);
    for (std::size_t i = 0; i < std::max(a.numbers.size(), b.numbers.size()); ++i) {
        const double x = at(a, i);
        const double y = at(b, i);
        if (operation == '/') judge.note(y == 0, "division by zero");
        result.numbers.push_back(operation == '+'   ? x + y
                                 : operation == '-' ? x - y
                                 : operation == '*' ? x * y
                                                    : x / y);
    }
    return judge.finish(std::move(result));
}

/// x / y or x % y, with what must not be.
double divided(bool is_remainder, std::int64_t x, std::int64_t y, Scalar scalar, Judge& judge) {
    judge.note(y == 0, is_remainder ? "integer remainder by zero" : "integer division by zero");
    judge.note(is_remainder && (x < 0 || y < 0), "integer remainder of a negative number");
    judge.note(!is_remainder && y == -1 && x == std::numeric_limits<std::int32_t>::min(),
               "integer division overflows");
    if (y == 0) return 0;
    return wrapped(is_remainder ? x % y : x / y, scalar);
}

std::string_view name_of_integer_operation(std::string_view operation, bool is_signed) {
    if (operation == "/") return is_signed ? "SDiv" : "UDiv";
    if (operation == "%") return is_signed ? "SMod" : "UMod";
    if (operation == "<<") return "ShiftLeftLogical";
    if (operation == ">>") return is_signed ? "ShiftRightArithmetic" : "ShiftRightLogical";
    return "";
}

double integer_number(std::string_view operation, std::int64_t x, std::int64_t y, Scalar scalar,
                      Judge& judge) {
    switch (operation.front()) {
        case '+':
            return wrapped(x + y, scalar);
        case '-':
            return wrapped(x - y, scalar);
        case '*':  // of two 32-bit numbers, so that it cannot overflow; of unsigned ones as those wrap
            return wrapped(
                static_cast<std::int64_t>(static_cast<std::uint64_t>(x) * static_cast<std::uint64_t>(y)),
                scalar);
        case '/':
        case '%':
            return divided(operation == "%", x, y, scalar, judge);
        case '&':
            return wrapped(x & y, scalar);
        case '|':
            return wrapped(x | y, scalar);
        case '^':
            return wrapped(x ^ y, scalar);
        default:
            judge.note(y < 0 || y > 31, "shift by more than 31 bits");
            if (operation == "<<")
                return wrapped(static_cast<std::int64_t>(static_cast<std::uint64_t>(x) << (y & 31)), scalar);
            return wrapped(x >> (y & 31), scalar);
    }
}

Constant integer_arithmetic(std::string_view operation, const ConstantValue& a, const ConstantValue& b,
                            const ReportFault& report) {
    const std::vector<Constant> operands{a, b};
    Judge judge(name_of_integer_operation(operation, a.type.scalar == Scalar::int32), operands, report);
    ConstantValue result = like(a, b);
    for (std::size_t i = 0; i < std::max(a.numbers.size(), b.numbers.size()); ++i)
        result.numbers.push_back(integer_number(operation, static_cast<std::int64_t>(at(a, i)),
                                                static_cast<std::int64_t>(at(b, i)), a.type.scalar, judge));
    return judge.finish(std::move(result));
}

ConstantValue truth(bool is_true) {
    return {{Scalar::boolean, 1, 1}, 0, {is_true ? 1.0 : 0.0}};
}

Constant compared(std::string_view operation, const ConstantValue& a, const ConstantValue& b) {
    const bool are_equal = a.numbers.size() == b.numbers.size() && std::ranges::equal(a.numbers, b.numbers);
    if (operation == "==") return truth(are_equal);
    if (operation == "!=") return truth(!are_equal);
    const double x = a.numbers.front();
    const double y = b.numbers.front();
    if (operation == "<") return truth(x < y);
    if (operation == ">") return truth(x > y);
    return truth(operation == "<=" ? x <= y : x >= y);
}

// Built-in functions. A row says what must not be given.

struct Function {
    std::string_view name;
    std::string_view operation;  ///< of SPIR-V
    double (*of)(double x, double y, double z);
    /// What is wrong with the operands, or empty.
    std::string_view (*fault)(double x, double y, double z) = nullptr;
};

using Text = std::string_view;
constexpr auto kNotPositive = [](double x) { return x <= 0; };

const Function kOneArgument[] = {
    {"radians", "Radians", [](double x, double, double) { return x * std::numbers::pi / 180; }},
    {"degrees", "Degrees", [](double x, double, double) { return x * 180 / std::numbers::pi; }},
    {"sin", "Sin", [](double x, double, double) { return std::sin(x); }},
    {"cos", "Cos", [](double x, double, double) { return std::cos(x); }},
    {"tan", "Tan", [](double x, double, double) { return std::tan(x); }},
    {"asin", "Asin", [](double x, double, double) { return std::asin(x); },
     [](double x, double, double) -> Text {
         return std::abs(x) > 1 ? "asin() of a number beyond [-1, 1]" : "";
     }},
    {"acos", "Acos", [](double x, double, double) { return std::acos(x); },
     [](double x, double, double) -> Text {
         return std::abs(x) > 1 ? "acos() of a number beyond [-1, 1]" : "";
     }},
    {"atan", "Atan", [](double x, double, double) { return std::atan(x); }},
    {"sinh", "Sinh", [](double x, double, double) { return std::sinh(x); }},
    {"cosh", "Cosh", [](double x, double, double) { return std::cosh(x); }},
    {"tanh", "Tanh", [](double x, double, double) { return std::tanh(x); }},
    {"asinh", "Asinh", [](double x, double, double) { return std::asinh(x); }},
    {"acosh", "Acosh", [](double x, double, double) { return std::acosh(x); },
     [](double x, double, double) -> Text { return x < 1 ? "acosh() of a number below 1" : ""; }},
    {"atanh", "Atanh", [](double x, double, double) { return std::atanh(x); },
     [](double x, double, double) -> Text {
         return std::abs(x) >= 1 ? "atanh() of a number not within (-1, 1)" : "";
     }},
    {"exp", "Exp", [](double x, double, double) { return std::exp(x); }},
    {"exp2", "Exp2", [](double x, double, double) { return std::exp2(x); }},
    {"log", "Log", [](double x, double, double) { return std::log(x); },
     [](double x, double, double) -> Text { return kNotPositive(x) ? "log() of a number not above 0" : ""; }},
    {"log2", "Log2", [](double x, double, double) { return std::log2(x); },
     [](double x, double, double) -> Text {
         return kNotPositive(x) ? "log2() of a number not above 0" : "";
     }},
    {"sqrt", "Sqrt", [](double x, double, double) { return std::sqrt(x); },
     [](double x, double, double) -> Text { return x < 0 ? "sqrt() of a negative number" : ""; }},
    {"inversesqrt", "InverseSqrt", [](double x, double, double) { return 1 / std::sqrt(x); },
     [](double x, double, double) -> Text {
         return kNotPositive(x) ? "inversesqrt() of a number not above 0" : "";
     }},
    {"abs", "FAbs", [](double x, double, double) { return std::abs(x); }},
    {"sign", "FSign", [](double x, double, double) { return double(x > 0) - double(x < 0); }},
    {"floor", "Floor", [](double x, double, double) { return std::floor(x); }},
    {"trunc", "Trunc", [](double x, double, double) { return std::trunc(x); }},
    {"round", "Round", [](double x, double, double) { return std::round(x); }},
    {"ceil", "Ceil", [](double x, double, double) { return std::ceil(x); }},
    {"fract", "Fract", [](double x, double, double) { return x - std::floor(x); }},
};
const Function kTwoArguments[] = {
    {"pow", "Pow", [](double x, double y, double) { return std::pow(x, y); },
     [](double x, double y, double) -> Text {
         if (x < 0) return "pow() of a negative number";
         return x == 0 && y <= 0 ? "pow(0, y) with y not above 0" : "";
     }},
    {"mod", "FMod", [](double x, double y, double) { return x - y * std::floor(x / y); },
     [](double, double y, double) -> Text { return y == 0 ? "mod() by zero" : ""; }},
    {"min", "FMin", [](double x, double y, double) { return y < x ? y : x; }},
    {"max", "FMax", [](double x, double y, double) { return x < y ? y : x; }},
    {"step", "Step", [](double edge, double x, double) { return x < edge ? 0.0 : 1.0; }},
    {"atan", "Atan2", [](double y, double x, double) { return std::atan2(y, x); },
     [](double y, double x, double) -> Text { return y == 0 && x == 0 ? "atan(0, 0)" : ""; }},
};
const Function kThreeArguments[] = {
    {"clamp", "FClamp", [](double x, double low, double high) { return std::min(std::max(x, low), high); },
     [](double, double low, double high) -> Text {
         return high < low ? "clamp() with its minimum above its maximum" : "";
     }},
    {"mix", "FMix", [](double x, double y, double a) { return x * (1 - a) + y * a; }},
    {"smoothstep", "SmoothStep",
     [](double low, double high, double x) {
         const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
         return t * t * (3 - 2 * t);
     },
     [](double low, double high, double) -> Text {
         if (low == high) return "smoothstep() with equal edges";
         return high < low ? "smoothstep() with its first edge above its second" : "";
     }},
    {"fma", "Fma", [](double a, double b, double c) { return a * b + c; }},
};

std::span<const Function> functions_of(std::size_t arguments) {
    if (arguments == 1) return kOneArgument;
    if (arguments == 2) return kTwoArguments;
    if (arguments == 3) return kThreeArguments;
    return {};
}

/// Of whole numbers what stays whole: min, max, abs, sign, clamp.
bool keeps_integers(std::string_view name) {
    constexpr std::array<std::string_view, 5> kNames = {"min", "max", "abs", "sign", "clamp"};
    return std::ranges::find(kNames, name) != kNames.end();
}

Constant by_component(const Function& function, std::vector<Constant> arguments, const ReportFault& report) {
    const auto is_whole = [](const Constant& one) { return !one->is_float(); };
    const bool are_integers = keeps_integers(function.name) && std::ranges::all_of(arguments, is_whole);
    std::size_t count = 1;
    GlslType type = arguments.front()->type;
    for (Constant& argument : arguments) {
        if (argument->type.scalar == Scalar::boolean || argument->type.is_matrix()) return std::nullopt;
        GlslType wanted = argument->type;
        if (!are_integers) wanted.scalar = Scalar::float32;
        argument = converted(argument, wanted);
        if (argument->numbers.size() < count) continue;
        count = argument->numbers.size();
        type = argument->type;
    }
    for (const Constant& argument : arguments)
        if (argument->numbers.size() != 1 && argument->numbers.size() != count) return std::nullopt;
    Judge judge(function.operation, arguments, report);
    ConstantValue result{type, 0, {}};
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> of{};
        for (std::size_t a = 0; a < arguments.size(); ++a) of[a] = at(*arguments[a], i);
        if (function.fault != nullptr) {
            const std::string_view fault = function.fault(of[0], of[1], of[2]);
            judge.note(!fault.empty(), fault);
        }
        result.numbers.push_back(function.of(of[0], of[1], of[2]));
    }
    return judge.finish(std::move(result));
}

double square_of(const ConstantValue& vector) {
    double square = 0;
    for (const double number : vector.numbers)
        square = nearest_float(square + nearest_float(number * number));
    return square;
}

constexpr double kSmallestNormal = std::numeric_limits<float>::min();

void judge_square(std::string_view function, const ConstantValue& vector, Judge& judge) {
    const bool is_zero = std::ranges::all_of(vector.numbers, [](double number) { return number == 0; });
    const double square = square_of(vector);
    if (function == "normalize") {
        judge.note(is_zero, "normalize() of a zero vector");
        judge.note(square < kSmallestNormal, "normalize() underflows: the square of the length is too small");
        judge.note(std::isinf(square), "normalize() overflows: the square of the length is too large");
        return;
    }
    judge.note(!is_zero && square < kSmallestNormal, "length() underflows: its square is too small");
    judge.note(std::isinf(square), "length() overflows: its square is too large");
}

Constant geometric(std::string_view function, const std::vector<Constant>& arguments,
                   const ReportFault& report) {
    const ConstantValue& a = *arguments.front();
    if (!a.is_float() || a.type.is_matrix()) return std::nullopt;
    if (function == "dot" && arguments.size() == 2 && arguments[1]->is_float() &&
        arguments[1]->numbers.size() == a.numbers.size()) {
        Judge judge("Dot", arguments, report);
        double sum = 0;
        for (std::size_t i = 0; i < a.numbers.size(); ++i)
            sum = nearest_float(sum + nearest_float(a.numbers[i] * arguments[1]->numbers[i]));
        return judge.finish({{Scalar::float32, 1, 1}, 0, {sum}});
    }
    if (arguments.size() != 1) return std::nullopt;
    if (function == "length") {
        Judge judge("Length", arguments, report);
        judge_square(function, a, judge);
        return judge.finish({{Scalar::float32, 1, 1}, 0, {std::sqrt(square_of(a))}});
    }
    if (function != "normalize") return std::nullopt;
    Judge judge("Normalize", arguments, report);
    judge_square(function, a, judge);
    ConstantValue result{a.type, 0, a.numbers};
    for (double& number : result.numbers) number /= std::sqrt(square_of(a));
    return judge.finish(std::move(result));
}

/// A number given to a constructor of that scalar.
double made(double number, Scalar from, Scalar to, Judge& judge) {
    if (to == Scalar::boolean) return number != 0 ? 1 : 0;
    if (to == Scalar::float32) return nearest_float(number);
    if (from != Scalar::float32) return wrapped(static_cast<std::int64_t>(number), to);
    const double whole = std::trunc(number);
    if (to == Scalar::int32) {
        judge.note(!(whole >= -2147483648.0 && whole <= 2147483647.0), "conversion to int out of range");
        return std::isnan(whole) ? 0 : std::clamp(whole, -2147483648.0, 2147483647.0);
    }
    judge.note(!(whole >= 0 && whole <= 4294967295.0), "conversion to uint out of range");
    return std::isnan(whole) ? 0 : std::clamp(whole, 0.0, 4294967295.0);
}

}  // namespace

Constant folded_binary(std::string_view operation, const Constant& first, const Constant& second,
                       const ReportFault& report) {
    Constant a = first;
    Constant b = second;
    if (!is_plain(a) || !is_plain(b)) return std::nullopt;
    if (operation == "&&" || operation == "||" || operation == "^^") {
        const bool x = a->numbers.front() != 0;
        const bool y = b->numbers.front() != 0;
        return truth(operation == "&&" ? x && y : operation == "||" ? x || y : x != y);
    }
    const bool shifts = operation == "<<" || operation == ">>";  // whose operands keep their types
    if (!shifts && !bring_together(a, b)) return std::nullopt;
    if (operation == "==" || operation == "!=" || operation.starts_with('<') || operation.starts_with('>'))
        if (!shifts) return compared(operation, *a, *b);
    if (a->type.scalar == Scalar::boolean) return std::nullopt;
    if (a->is_float()) {
        const bool multiplies_matrix = operation == "*" && a->type.is_matrix() != b->type.is_matrix() &&
                                       a->numbers.size() > 1 && b->numbers.size() > 1;
        if (multiplies_matrix || (operation == "*" && a->type.is_matrix() && b->type.is_matrix()))
            return std::nullopt;
        if (operation.size() != 1 || std::string_view("+-*/").find(operation) == std::string_view::npos)
            return std::nullopt;
        return float_arithmetic(operation.front(), *a, *b, report);
    }
    if (shifts && (b->is_float() || (b->numbers.size() != 1 && b->numbers.size() != a->numbers.size())))
        return std::nullopt;
    return integer_arithmetic(operation, *a, *b, report);
}

Constant folded_unary(std::string_view operation, const Constant& a) {
    if (!is_plain(a) || operation == "+") return a;
    ConstantValue result = *a;
    for (double& number : result.numbers) {
        if (operation == "!")
            number = number == 0 ? 1 : 0;
        else if (operation == "~")
            number = wrapped(~static_cast<std::int64_t>(number), a->type.scalar);
        else
            number = a->is_float() ? -number : wrapped(-static_cast<std::int64_t>(number), a->type.scalar);
    }
    return result;
}

Constant folded_call(std::string_view function, const std::vector<Constant>& arguments,
                     const ReportFault& report) {
    if (arguments.empty() || !std::ranges::all_of(arguments, is_plain)) return std::nullopt;
    if (function == "length" || function == "dot" || function == "normalize")
        return geometric(function, arguments, report);
    for (const Function& known : functions_of(arguments.size()))
        if (known.name == function) return by_component(known, arguments, report);
    return std::nullopt;
}

Constant constructed(const GlslType& type, const std::vector<Constant>& arguments,
                     const ReportFault& report) {
    if (arguments.empty() || !std::ranges::all_of(arguments, is_plain)) return std::nullopt;
    const auto count = static_cast<std::size_t>(type.components());
    if (type.scalar != Scalar::float32 && type.scalar != Scalar::boolean && !is_integer(type.scalar))
        return std::nullopt;
    Judge judge(type.scalar == Scalar::uint32 ? "ConvertFToU" : "ConvertFToS", arguments, report);
    ConstantValue result{type, 0, {}};
    for (const Constant& argument : arguments) {
        if (type.is_matrix() && argument->type.is_matrix()) return std::nullopt;
        for (const double number : argument->numbers)
            if (result.numbers.size() < count)
                result.numbers.push_back(made(number, argument->type.scalar, type.scalar, judge));
    }
    const bool is_single = arguments.size() == 1 && arguments.front()->numbers.size() == 1;
    if (is_single && type.is_matrix()) {
        const double number = result.numbers.front();
        result.numbers.assign(count, 0);
        for (int i = 0; i < std::min(type.columns, type.rows); ++i)
            result.numbers[static_cast<std::size_t>(i * type.rows + i)] = number;
    } else if (is_single) {
        result.numbers.assign(count, result.numbers.front());
    }
    if (result.numbers.size() != count) return std::nullopt;
    return judge.finish(std::move(result));
}

Constant array_of(const std::vector<Constant>& elements) {
    if (elements.empty() || !is_plain(elements.front())) return std::nullopt;
    ConstantValue result{elements.front()->type, static_cast<int>(elements.size()), {}};
    for (const Constant& element : elements) {
        if (!is_plain(element) || element->type != result.type) return std::nullopt;
        result.numbers.insert(result.numbers.end(), element->numbers.begin(), element->numbers.end());
    }
    return result;
}

Constant converted(const Constant& value, const GlslType& type) {
    if (!value || type.components() != value->type.components()) return std::nullopt;
    if (type.scalar == value->type.scalar) return value;
    if (value->elements != 0 || value->is_float()) return std::nullopt;  // floats convert only when asked
    ConstantValue result{type, 0, {}};
    for (const double number : value->numbers)
        result.numbers.push_back(type.scalar == Scalar::float32
                                     ? nearest_float(number)
                                     : wrapped(static_cast<std::int64_t>(number), type.scalar));
    return result;
}

Constant components_of(const Constant& value, std::string_view names) {
    if (!is_plain(value) || value->type.is_matrix() || names.size() > 4) return std::nullopt;
    ConstantValue result{{value->type.scalar, 1, static_cast<int>(names.size())}, 0, {}};
    for (const char name : names) {
        std::size_t index = std::string_view::npos;
        for (const std::string_view set : {"xyzw", "rgba", "stpq"})
            if (set.find(name) != std::string_view::npos) index = set.find(name);
        if (index >= value->numbers.size()) return std::nullopt;
        result.numbers.push_back(value->numbers[index]);
    }
    return result;
}

Constant element_of(const Constant& value, const Constant& index) {
    if (!value || !is_plain(index) || index->is_float()) return std::nullopt;
    GlslType type = value->type;
    if (value->elements == 0) {
        if (type.is_matrix())
            type.columns = 1;
        else
            type.rows = 1;
    }
    const auto size = static_cast<std::size_t>(type.components());
    const double first = index->numbers.front() * static_cast<double>(size);
    if (first < 0 || first + static_cast<double>(size) > static_cast<double>(value->numbers.size()))
        return std::nullopt;
    const auto begin = value->numbers.begin() + static_cast<std::ptrdiff_t>(first);
    return ConstantValue{type, 0, {begin, begin + static_cast<std::ptrdiff_t>(size)}};
}

std::optional<bool> truth_of(const Constant& value) {
    if (!is_plain(value) || value->type.scalar != Scalar::boolean || value->numbers.size() != 1)
        return std::nullopt;
    return value->numbers.front() != 0;
}

}  // namespace gobo::sanitize
