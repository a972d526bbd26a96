// A study: what a set of measurements found, as a page of text, pictures and tables that reports can take in.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace porosph::render {

struct StudyPicture {
  std::string file;         ///< its name in the study's folder
  std::string description;  ///< for those who do not see it
  std::string caption;
};

struct StudyTable {
  std::string caption;
  std::vector<std::vector<std::string>> rows;  ///< the first row: heads; the first column heads its row
  bool numbers = true;                         ///< the other columns are numbers: right-aligned
};

/// Shown in this order: text, tables, pictures.
struct StudySection {
  std::string heading;
  std::vector<std::string> paragraphs;
  std::vector<StudyTable> tables;
  std::vector<StudyPicture> pictures;
};

struct Study {
  std::string title;
  std::string lead;  ///< what was measured, in a sentence or two
  std::vector<StudySection> sections;
  std::vector<std::string> files;  ///< tables for other programs (CSV), by their names in the study's folder
  std::string command;             ///< the command line that makes the study
};

/// Writes index.html and study.json beside the pictures and files, which must already be in `folder`. Throws
/// std::invalid_argument for a table without rows or with rows of unequal length, ReadError for a picture or
/// file that is not in the folder, WriteError.
void write_study(const Study& study, const std::filesystem::path& folder);

/// Whether the folder holds a study (a study.json).
bool is_study(const std::filesystem::path& folder);

/// The study of a folder. Throws ReadError, also for a picture or file that is missing.
Study read_study(const std::filesystem::path& folder);

/// As in study.json.
nlohmann::ordered_json to_json(const Study& study);

/// Reads the study in `from`, copies its pictures into `report`, where their names begin with `prefix`, and
/// returns it as a section of a page there. Throws ReadError, WriteError.
std::string study_section(const std::filesystem::path& from, const std::filesystem::path& report,
                          const std::string& prefix);

}  // namespace porosph::render
