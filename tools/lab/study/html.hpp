// Writing HTML and SVG: text made safe for where it stands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gobo::study {

/// `text` for use between tags and in attributes.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// JSON within a <script> element, which a `<` could end or comment out.
[[nodiscard]] std::string html_script(std::string json);

/// The bytes of a file as a data URL: "data:image/png;base64,...".
[[nodiscard]] std::string data_url(std::string_view media_type, std::string_view bytes);

/// An <option>.
[[nodiscard]] std::string html_option(std::string_view value, std::string_view label);

struct HtmlRow {
    std::vector<std::string> cells;
    std::string row_class = {};  ///< empty: none
};

/// A table: the header's cells and the rows'; a cell that begins with a digit, a sign or a multiplication
/// sign is set as a number.
[[nodiscard]] std::string html_table(const std::vector<std::string>& header,
                                     const std::vector<HtmlRow>& rows);

}  // namespace gobo::study
