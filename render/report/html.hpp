// The pieces of a static page: escaped text, tables, pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace porosph::render::html {

/// Text as it may stand anywhere in the page.
std::string escaped(const std::string& text);

/// First row: heads. Cells are escaped here; the first column heads its row. `numbers`: other columns
/// right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows, bool numbers = true);

/// A picture and, for narrow windows, its panels one below the other, drawn for these; each is a link to
/// itself in full size. Files lie beside the page. `description` is read out where the picture is not seen,
/// `caption` stands below.
std::string figure(const std::string& file, const std::string& description, const std::string& caption,
                   const std::vector<std::string>& panels = {});

struct Instant {
  std::string file, caption;
};
/// Pictures that a script plays one after the other; without it a strip to be scrolled through.
std::string player(const std::vector<Instant>& frames, const std::string& description);

/// Two pictures of one size that a script lays upon each other, with a slider between; without it one is
/// below the other.
std::string slider(const Instant& a, const Instant& b);

/// `style`: a class of the page's style sheet; empty for plain text.
std::string paragraph(const std::string& text, const std::string& style = "");

/// With an anchor made of the heading's letters.
std::string section(const std::string& heading, const std::string& content);

/// Links to the sections of a body, in their order.
std::string contents(const std::string& body);

/// The page with its pictures in it: those that lie in `folder` and that it refers to. Throws ReadError.
std::string with_pictures(std::string page, const std::filesystem::path& folder);

/// Names of the files that the page shows as pictures.
std::vector<std::string> pictures_of(const std::string& page);

/// A whole page, light or dark as the reader's system is, fit to be printed, without outside files. A small
/// script drives players and sliders; the page is whole without it.
std::string page(const std::string& title, const std::string& body);

}  // namespace porosph::render::html
