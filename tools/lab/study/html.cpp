#include "lab/study/html.hpp"

#include <cctype>
#include <cstdint>

#include <fmt/format.h>

namespace gobo::study {
namespace {

bool is_number(const std::string& cell) {
    return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) != 0 || cell[0] == '-' ||
                             cell[0] == '+' || cell.starts_with("\u00d7"));
}

}  // namespace

std::string html_escaped(std::string_view text) {
    std::string result;
    for (const char character : text) {
        if (character == '&')
            result += "&amp;";
        else if (character == '<')
            result += "&lt;";
        else if (character == '>')
            result += "&gt;";
        else if (character == '"')
            result += "&quot;";
        else
            result += character;
    }
    return result;
}

std::string html_script(std::string json) {
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
        json.replace(at, 1, "\\u003c");
    return json;
}

std::string data_url(std::string_view media_type, std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = fmt::format("data:{};base64,", media_type);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
    }
    return text;
}

std::string html_option(std::string_view value, std::string_view label) {
    return fmt::format("<option value=\"{}\">{}</option>", html_escaped(value), html_escaped(label));
}

std::string html_table(const std::vector<std::string>& header, const std::vector<HtmlRow>& rows) {
    std::string text = "<table>\n<tr>";
    for (const std::string& cell : header) text += "<th>" + html_escaped(cell) + "</th>";
    text += "</tr>\n";
    for (const HtmlRow& row : rows) {
        text += row.row_class.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", row.row_class);
        for (const std::string& cell : row.cells)
            text +=
                fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", html_escaped(cell));
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

}  // namespace gobo::study
