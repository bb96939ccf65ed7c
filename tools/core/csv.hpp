// Tables of text: RFC 4180, a header line, '\n'.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  ///< as many cells as there are columns

    /// Nothing where there is no such column.
    [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
};

/// A byte order mark is skipped. Rows with fewer cells are filled up with empty ones, further cells left out.
[[nodiscard]] CsvTable read_csv(std::string_view text);

/// The table as read_csv() reads it.
[[nodiscard]] std::string csv_text(const CsvTable& table);

/// An error at a row of the table at `path`.
[[nodiscard]] tl::unexpected<Diagnostics> fail_at_row(const std::string& path, std::size_t row,
                                                      std::string message, std::string help);

}  // namespace gobo
