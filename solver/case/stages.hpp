// A case with stages, from one stage to the next.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/case/check_case.hpp"

namespace porosph {

/// Follows a case through its stages. Each stage is a case of its own, in which only what is there then has
/// a place: soils, boundaries and loads, with the settings that hold then. Stage 0 is what the case says
/// before its first [[stage]]; a case without stages has no other, and that one is the case itself.
class StagePlan {
 public:
  /// A case that read_case() gave, or one whose stages are to be checked.
  explicit StagePlan(const Case& scene);

  const Case& scene() const { return current_; }  ///< of the present stage; its end is a time of the run [s]
  std::size_t stage() const { return stage_; }
  bool is_last() const { return stage_ == stages_.size(); }
  std::string name() const { return stage_ == 0 ? "start" : stages_[stage_ - 1].name; }
  bool resets_displacements() const { return stage_ > 0 && stages_[stage_ - 1].reset_displacements; }
  /// The table that the present stage is; null before the first.
  const StageCase* table() const { return stage_ > 0 ? &stages_[stage_ - 1] : nullptr; }
  /// What the stage changes, for people: "removes 'pit'", ...
  std::vector<std::string> changes() const;

  /// Goes on to the next stage, which begins at a time of the run [s]. What is wrong with the stage comes
  /// back, at its keys; the plan is of no use then.
  std::vector<CaseIssue> go_on(double time);

  /// Pieces that stages cut the soils into, as soils; all of them, present or not.
  const Case& whole() const { return *plan_; }

 private:
  struct Piece {
    int soil;                ///< in file_
    SoilCase shape;          ///< name, polygon and holes of it
    std::vector<int> areas;  ///< excavate_within, counted through all stages, that it lies in
    bool present = true;
  };
  void cut_soils();
  void find_absent();
  void change_settings(const StageCase& stage, const std::string& key, double time,
                       std::vector<CaseIssue>& issues);
  void change_soils(const StageCase& stage, const std::string& key, std::vector<CaseIssue>& issues);
  void change_loads(const StageCase& stage, const std::string& key, double time,
                    std::vector<CaseIssue>& issues);
  void change_footings(const StageCase& stage, const std::string& key, double time,
                       std::vector<CaseIssue>& issues);
  void change_sheets(const StageCase& stage, const std::string& key, std::vector<CaseIssue>& issues);
  void change_supports(const StageCase& stage, const std::string& key, std::vector<CaseIssue>& issues);
  std::vector<SoilCase> soils(bool all) const;
  void make_current(double end);

  Case file_;  ///< with the settings that hold now
  std::vector<StageCase> stages_;
  std::vector<Piece> pieces_;
  std::vector<char> load_on_, footing_on_, sheet_on_, support_on_;
  std::shared_ptr<const Case> plan_;
  std::size_t stage_ = 0;
  int areas_ = 0;  ///< excavate_within of the stages so far
  Case current_;
};

/// Throws std::runtime_error where a case has stages or starts from another run, which `who` does not follow.
void require_plain(const Case& scene, std::string_view who);

/// The last stage of a case, as planned; the case itself where there are none.
Case last_stage(const Case& scene);

/// Time at which the last stage of a case ends if none comes to rest before [s].
double latest_end(const Case& scene);

}  // namespace porosph
