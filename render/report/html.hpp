// The pieces of a static page: escaped text, tables, pictures.
#pragma once

#include <string>
#include <vector>

namespace porosph::html {

/// Text as it may stand anywhere in the page.
std::string escaped(const std::string& text);

/// First row: heads. Cells are escaped here; the first column heads its row. `numbers`: other columns
/// right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows, bool numbers = true);

/// `file` lies beside the page. `description` is read out where the picture is not seen, `caption` stands
/// below it.
std::string figure(const std::string& file, const std::string& description, const std::string& caption);

/// `style`: a class of the page's style sheet; empty for plain text.
std::string paragraph(const std::string& text, const std::string& style = "");

std::string section(const std::string& heading, const std::string& content);

/// A whole page, light or dark as the reader's system is, fit to be printed, without scripts or outside
/// files.
std::string page(const std::string& title, const std::string& body);

}  // namespace porosph::html
