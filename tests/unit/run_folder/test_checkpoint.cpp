#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "solver/case/case_file.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/checkpoint.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

const std::string case_text = "title = \"A case\"\n";

Case soft_column(Motion motion) {
  Case scene = box_of_soil(4, 8);
  scene.soils[0].youngs_modulus = 2e5;  // the reference must be renewed now and then
  hold_as_column(scene);
  add_water(scene, 5);
  scene.formulation = default_formulation(motion);
  scene.loading.damping = 0.05;
  scene.time.end = 10;
  scene.stop.unbalanced_force_ratio = 1e-2;
  return scene;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void check_same_state(const Simulation& a, const Simulation& b) {
  const Particles &p = a.model().particles, &q = b.model().particles;
  CHECK(a.step() == b.step());
  CHECK(same_bits(p.position, q.position));
  CHECK(same_bits(p.velocity, q.velocity));
  CHECK(same_bits(p.stress, q.stress));
  CHECK(same_bits(p.density, q.density));
  CHECK(same_bits(p.pore_pressure, q.pore_pressure));
  CHECK(a.dynamics().counts.searches == b.dynamics().counts.searches);
  CHECK(a.dynamics().counts.refreshes == b.dynamics().counts.refreshes);
}

}  // namespace

TEST_CASE("a restored simulation continues to the same bits", "[checkpoint]") {
  const Motion motion = GENERATE(Motion::consistent, Motion::proposed, Motion::conventional);
  const int steps_before = GENERATE(0, 1, 40, 133);
  const bool looked_at = GENERATE(false, true);  // looking at the forces prepares the next step
  Case scene = soft_column(motion);
  scene.stop.on_separation = false;
  scene.loading.adaptive_damping = looked_at;
  Simulation original(scene), restored(scene);
  for (int i = 0; i < steps_before; ++i) original.advance();
  if (looked_at) original.remember();
  StateWriter writer;
  original.visit(writer);
  StateReader reader(writer.content());
  restored.visit(reader);
  reader.finish();
  for (int i = 0; i < 60; ++i) original.advance(), restored.advance();
  check_same_state(original, restored);
  REQUIRE(original.exchange_with_last_good() == looked_at);
  REQUIRE(restored.exchange_with_last_good() == looked_at);
  check_same_state(original, restored);
}

TEST_CASE("soils that meet and yield continue to the same bits", "[checkpoint]") {
  const int steps_before = GENERATE(1, 40, 133);
  Case scene = soft_column(Motion::consistent);
  SoilCase upper = scene.soils[0];
  scene.soils[0].polygon = box_outline(0, 0, 2, 2), upper.polygon = box_outline(0, 2, 2, 4);
  upper.name = "upper", upper.youngs_modulus = 5e4, upper.poissons_ratio = 0.1;
  scene.soils.push_back(upper);
  scene.soils[0].velocity = Point(0.3, 0);
  Simulation original(scene), restored(scene);
  for (Simulation* s : {&original, &restored})
    s->set_law("upper", DruckerPrager::from_mohr_coulomb(LinearElastic::from_young(5e4, 0.1), 1e3, 20));
  for (int i = 0; i < steps_before; ++i) original.advance();
  StateWriter writer;
  original.visit(writer);
  StateReader reader(writer.content());
  restored.visit(reader);
  reader.finish();
  for (int i = 0; i < 60; ++i) original.advance(), restored.advance();
  check_same_state(original, restored);
  const Particles &p = original.model().particles, &q = restored.model().particles;
  CHECK(same_bits(p.interface_stress, q.interface_stress));
  CHECK(p.history[0].values == q.history[0].values);
  CHECK(std::ranges::any_of(p.history[0].values, [](double strain) { return strain > 1e-3; }));
  CHECK(std::ranges::any_of(p.interface_stress, [](double tau) { return tau != 0; }));
  CHECK(original.dynamics().counts.refreshes > 1);
}

TEST_CASE("a run that is resumed records what the whole run records", "[checkpoint]") {
  Case scene = soft_column(Motion::consistent);
  scene.output.interval = 0.13;
  using Rows = std::vector<std::vector<double>>;
  struct Records {
    std::vector<double> frames;
    Rows rows;
    RunWatch watch() {
      return {.frame = [this](Simulation& s) { frames.push_back(s.time()); },
              .history = [this](const std::vector<double>& row) { rows.push_back(row); },
              .progress = {},
              .interrupted = {},
              .checkpoint = {}};
    }
  };
  Records whole, parts;
  Simulation uninterrupted(scene);
  const RunOutcome outcome = run(uninterrupted, whole.watch());
  REQUIRE(outcome.status == RunStatus::equilibrium);

  Simulation first(scene), second(scene);
  StateWriter state;
  std::size_t frames_then = 0, rows_then = 0;
  RunWatch stopped = parts.watch();
  stopped.interrupted = [&] { return first.step() == uninterrupted.step() / 2; };
  stopped.checkpoint = [&](Simulation& s, RunProgress& progress, bool ending) {
    if (!ending) return;
    s.visit(state);
    progress.visit(state);
    frames_then = parts.frames.size(), rows_then = parts.rows.size();
  };
  REQUIRE(run(first, stopped).status == RunStatus::interrupted);
  CHECK(parts.frames.size() == frames_then + 1);  // the state it stopped at, which the resumed run replaces
  parts.frames.resize(frames_then), parts.rows.resize(rows_then);

  StateReader reader(state.content());
  RunProgress progress;
  second.visit(reader);
  progress.visit(reader);
  const RunOutcome resumed = run(second, parts.watch(), progress);
  check_same_state(uninterrupted, second);
  CHECK(resumed.status == outcome.status);
  CHECK(resumed.energy_growth == outcome.energy_growth);
  CHECK(parts.frames == whole.frames);
  CHECK(parts.rows == whole.rows);
}

TEST_CASE("a state of something else is refused", "[checkpoint]") {
  Simulation small(box_of_soil(3, 3)), large(box_of_soil(3, 4));
  StateWriter writer;
  small.visit(writer);
  StateReader reader(writer.content());
  CHECK_THROWS_WITH(large.visit(reader), Contains("'position'"));
  StateReader empty("");
  CHECK_THROWS_WITH(small.visit(empty), Contains("ends before 'step'"));
  StateReader longer(writer.content());
  CHECK_THROWS_AS(longer.finish(), StateError);
}

namespace {

StateBytes poured(std::string state) {
  return [state = std::move(state)](const ByteSink& sink) { sink(state); };
}

}  // namespace

TEST_CASE("a folder keeps the newest state and the one before it", "[checkpoint]") {
  const TemporaryFolder folder;
  CHECK_FALSE(has_checkpoint(folder.path()));
  CHECK_FALSE(find_state(folder.path(), case_text));
  for (const char* state : {"first", "second", "third"})
    write_checkpoint(folder.path(), case_text, poured(state));
  CHECK(has_checkpoint(folder.path()));
  CHECK(find_state(folder.path(), case_text)->state == "third");
  CHECK(find_state(folder.path(), case_text)->note.empty());
  CHECK(names_in(folder.path()).size() == 2);
  std::filesystem::remove(folder / "checkpoint.bin");
  CHECK(find_state(folder.path(), case_text)->state == "second");
  remove_checkpoints(folder.path());
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("a checkpoint damaged anywhere is passed over for the one before it", "[checkpoint]") {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), case_text, poured("first"));
  write_checkpoint(folder.path(), case_text, poured("second"));
  const std::string previous = content(folder / "checkpoint.previous.bin"),
                    sound = content(folder / "checkpoint.bin");
  const auto check_fallback = [&](const std::string& damaged) {
    put(folder / "checkpoint.bin", damaged);
    put(folder / "checkpoint.previous.bin", previous);
    const auto found = find_state(folder.path(), case_text);
    REQUIRE(found);
    CHECK(found->state == "first");
    CHECK_THAT(found->note, Contains("checkpoint.bin"));
    CHECK(content(folder / "checkpoint.bin") == previous);  // so that a sound one stays when the next is kept
  };
  for (std::size_t i = 0; i < sound.size(); ++i) {
    CAPTURE(i);
    std::string flipped = sound;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    check_fallback(flipped);
    check_fallback(sound.substr(0, i));
  }
}

TEST_CASE("where no checkpoint is left, one message says why", "[checkpoint]") {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), case_text, poured("first"));
  CHECK_THROWS_WITH(find_state(folder.path(), "title = \"Another\"\n"),
                    Contains("checkpoint.bin") && Contains("belongs to another case"));
  put(folder / "checkpoint.bin", "");
  CHECK_THROWS_WITH(find_state(folder.path(), case_text), Contains("it is not a checkpoint"));
  put(folder / "checkpoint.bin", std::string("Porosph checkpoint\n\x09\0\0\0\0\0\0\0", 27));
  CHECK_THROWS_WITH(find_state(folder.path(), case_text), Contains("its format is 9, this program's is 3"));
  put(folder / "checkpoint.previous.bin", "rubbish");
  CHECK_THROWS_AS(find_state(folder.path(), case_text), ReadError);
}

TEST_CASE("on a full disk the checkpoint before stays", "[checkpoint]") {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), case_text, poured("first"));
  {
    const FileSizeLimit limit(1000);
    CHECK_THROWS_WITH(write_checkpoint(folder.path(), case_text, poured(std::string(5000, 'x'))),
                      Contains("checkpoint.bin") && Contains("File too large"));
  }
  CHECK(find_state(folder.path(), case_text)->state == "first");
  CHECK(names_in(folder.path()).size() == 1);
}
