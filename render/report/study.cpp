#include "render/report/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render/report/html.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph::render {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void check_tables(const Study& study) {
  for (const StudySection& section : study.sections)
    for (const StudyTable& table : section.tables) {
      const auto& rows = table.rows;
      if (rows.empty() || std::any_of(rows.begin(), rows.end(),
                                      [&](const auto& row) { return row.size() != rows.front().size(); }))
        throw std::invalid_argument("table '" + table.caption +
                                    "' of a study has no rows or rows of unequal length");
    }
}

/// Names only, and no symbolic links, so that a study can be moved and cannot reach out of its folder: what
/// it names is copied into reports.
void require_file(const fs::path& folder, const std::string& name) {
  const bool is_name = !name.empty() && fs::path(name).filename() == name && control_character(name).empty();
  const fs::path file = is_name ? folder / name : folder / printable(name);
  std::error_code none;
  const fs::file_status status = fs::symlink_status(file, none);
  if (is_name && fs::is_symlink(status))
    throw ReadError(file, "the study names it, but it is a symbolic link, which may lead out of its folder");
  if (!is_name || !fs::is_regular_file(status))
    throw ReadError(file, "the study names it, but it is not a file in the study's folder");
}

void require_plain_text(const Json& json) {
  if (json.is_structured())
    for (const auto& item : json.items()) require_plain_text(item.value());
  if (!json.is_string()) return;
  if (const std::string control = control_character(json.get<std::string>()); !control.empty())
    throw std::invalid_argument("a text of the study holds control characters: " + control);
}

void require_files(const Study& study, const fs::path& folder) {
  for (const StudySection& section : study.sections)
    for (const StudyPicture& picture : section.pictures) require_file(folder, picture.file);
  for (const std::string& file : study.files) require_file(folder, file);
}

std::string content_of(const StudySection& section, const std::string& prefix) {
  std::string text;
  for (const std::string& paragraph : section.paragraphs) text += html::paragraph(paragraph);
  for (const StudyTable& table : section.tables) {
    if (!table.caption.empty()) text += html::paragraph(table.caption);
    text += html::table(table.rows, table.numbers);
  }
  for (const StudyPicture& picture : section.pictures)
    text += html::figure(prefix + picture.file, picture.description, picture.caption);
  return text;
}

std::string page_of(const Study& study) {
  std::string body = "<h1>" + html::escaped(study.title) + "</h1>\n" + html::paragraph(study.lead, "lead");
  for (const StudySection& section : study.sections)
    body += html::section(section.heading, content_of(section, ""));
  std::string reproduce;
  if (!study.files.empty()) {
    reproduce += "<p>The numbers:";
    for (const std::string& file : study.files)
      reproduce += fmt::format(" <a href=\"{0}\">{0}</a>", html::escaped(file));
    reproduce += "</p>\n";
  }
  reproduce += "<pre>" + html::escaped(study.command) + "</pre>\n";
  return html::page(study.title, body + html::section("How to reproduce", reproduce));
}

StudySection section_from(const Json& json) {
  StudySection section{
      .heading = json.at("heading"), .paragraphs = json.at("paragraphs"), .tables = {}, .pictures = {}};
  for (const Json& table : json.at("tables"))
    section.tables.push_back(
        {.caption = table.at("caption"), .rows = table.at("rows"), .numbers = table.at("numbers")});
  for (const Json& picture : json.at("pictures"))
    section.pictures.push_back({.file = picture.at("file"),
                                .description = picture.at("description"),
                                .caption = picture.at("caption")});
  return section;
}

Study study_from(const Json& json) {
  Study study{.title = json.at("title"),
              .lead = json.at("lead"),
              .sections = {},
              .files = json.at("files"),
              .command = json.at("command")};
  for (const Json& section : json.at("sections")) study.sections.push_back(section_from(section));
  check_tables(study);
  return study;
}

}  // namespace

Json to_json(const Study& study) {
  Json sections = Json::array();
  for (const StudySection& section : study.sections) {
    Json tables = Json::array(), pictures = Json::array();
    for (const StudyTable& t : section.tables)
      tables.push_back({{"caption", t.caption}, {"rows", t.rows}, {"numbers", t.numbers}});
    for (const StudyPicture& p : section.pictures)
      pictures.push_back({{"file", p.file}, {"description", p.description}, {"caption", p.caption}});
    sections.push_back({{"heading", section.heading},
                        {"paragraphs", section.paragraphs},
                        {"tables", tables},
                        {"pictures", pictures}});
  }
  return {{"title", study.title},
          {"lead", study.lead},
          {"sections", sections},
          {"files", study.files},
          {"command", study.command}};
}

void write_study(const Study& study, const fs::path& folder) {
  check_tables(study);
  require_files(study, folder);
  const std::string json = to_json(study).dump(2, ' ', false, Json::error_handler_t::replace);
  write_file(folder / "index.html", page_of(study));
  write_file(folder / "study.json", json + "\n");
}

bool is_study(const fs::path& folder) { return fs::exists(folder / "study.json"); }

Study read_study(const fs::path& folder) {
  const fs::path file = folder / "study.json";
  const std::string text = read_file(file);
  try {
    const Json json = Json::parse(text);
    require_plain_text(json);
    Study study = study_from(json);
    require_files(study, folder);
    return study;
  } catch (const Json::exception& error) {
    throw ReadError(file, error.what());
  } catch (const std::invalid_argument& error) {
    throw ReadError(file, error.what());
  }
}

std::string study_section(const fs::path& from, const fs::path& report, const std::string& prefix) {
  const Study study = read_study(from);
  std::string content = html::paragraph(study.lead, "lead");
  for (const StudySection& section : study.sections) {
    content += "<h3>" + html::escaped(section.heading) + "</h3>\n" + content_of(section, prefix);
    for (const StudyPicture& picture : section.pictures)
      write_file(report / (prefix + picture.file), read_file(from / picture.file));
  }
  return html::section(study.title, content + "<pre>" + html::escaped(study.command) + "</pre>\n");
}

}  // namespace porosph::render
