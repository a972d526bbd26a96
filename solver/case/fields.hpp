// How the keys of a case are declared: once each, to whoever reads, writes or documents them.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// A key of a case file: its name, unit, meaning, and when it must or may be given.
struct Key {
  std::string_view name, unit, meaning;
  bool is_required = false;
  bool is_used = true;    ///< false: giving it is an error
  std::string condition;  ///< of being used, for people
  std::string fallback;   ///< what holds when it is not given, where that is not a plain default

  Key(std::string_view name_, std::string_view unit_, std::string_view meaning_)
      : name(name_), unit(unit_), meaning(meaning_) {}
  Key required() && { return is_required = true, std::move(*this); }
  Key only_if(bool used, std::string text) && {
    return is_used = used, condition = std::move(text), std::move(*this);
  }
  Key otherwise(std::string text) && { return fallback = std::move(text), std::move(*this); }
};

/// The numbers that a key allows.
struct Range {
  double min = -never, max = never;
  bool min_included = true, max_included = true;

  bool contains(double x) const {
    return (min_included ? x >= min : x > min) && (max_included ? x <= max : x < max);
  }
  std::string text() const;  ///< "> 0 and <= 3"; "any" without limits
};
inline Range above(double min, double max) { return {.min = min, .max = max, .min_included = false}; }
inline Range between(double min, double max) { return {.min = min, .max = max}; }
// Far beyond any use, yet products of such numbers are finite.
inline constexpr double farthest = 1e8;        ///< coordinate [m]
inline constexpr double stiffest = 1e15;       ///< Young's modulus [Pa]
inline constexpr double heaviest = 1e9;        ///< unit weight [N/m3]
inline constexpr double longest = 1e9;         ///< time [s]
inline constexpr double most_permeable = 1e3;  ///< hydraulic conductivity [m/s]

class Fields;
void declare(Fields&, Case&);
void declare(Fields&, ParticlesCase&);
void declare(Fields&, SoilCase&);
void declare(Fields&, WaterCase&);
void declare(Fields&, RetentionCase&);
void declare(Fields&, HydraulicFaceCase&);
void declare(Fields&, DrainCase&);
void declare(Fields&, FlowSectionCase&);
void declare(Fields&, WaterStretch&);
void declare(Fields&, BoundaryCase&);
void declare(Fields&, LoadCase&);
void declare(Fields&, FootingCase&);
void declare(Fields&, SheetCase&);
void declare(Fields&, FormulationCase&);
void declare(Fields&, LoadingCase&);
void declare(Fields&, ShakingCase&);
void declare(Fields&, TimeCase&);
void declare(Fields&, StopCase&);
void declare(Fields&, CheckCase&);
void declare(Fields&, OutputCase&);
void declare(Fields&, ProbeCase&);
void declare(Fields&, StageCase&);

/// Someone to whom keys are declared. A reader sets the values, the others look at them.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual void number(const Key&, double&, const Range& = {}) = 0;
  /// A number, or one word in its place.
  virtual void number_or(const Key&, double&, const Range&, std::string_view word, bool& is_word) = 0;
  virtual void numbers(const Key&, std::vector<double>&, const Range&) = 0;  ///< each in the range
  virtual void integer(const Key&, int&, const Range&) = 0;
  virtual void flag(const Key&, bool&) = 0;
  /// A truth, or one word in its place.
  virtual void flag_or(const Key&, bool&, std::string_view word, bool& is_word) = 0;
  virtual void text(const Key&, std::string&) = 0;
  virtual void name(const Key&,
                    std::string&) = 0;  ///< letters, digits, '_' and '-': fit for paths and column heads
  virtual void words(const Key&, std::vector<std::string>&, std::span<const std::string> allowed) = 0;
  virtual void texts(const Key&, std::vector<std::string>&) = 0;  ///< a list of any
  virtual void point(const Key&, Point&) = 0;
  virtual void pairs(const Key&, std::vector<Point>&) = 0;  ///< [a, b], a increasing; may be left out
  virtual void polygon(const Key&, Polygon&) = 0;
  virtual void polygons(const Key&, std::vector<Polygon>&) = 0;

  template <class Enum>
  void choice(const Key& key, Enum& value, std::span<const std::string_view> names) {
    int index = static_cast<int>(value);
    one_of(key, index, names);
    value = static_cast<Enum>(index);
  }
  /// A table; one that is not `present` is only looked at where the file has it.
  template <class T>
  void table(const Key& key, T& value, bool present = true) {
    section(key, present, [&] { declare(*this, value); });
  }
  /// A list of tables.
  template <class T>
  void tables(const Key& key, std::vector<T>& values) {
    list(key, values.size(), [&](std::size_t i) {
      if (i >= values.size()) values.resize(i + 1);
      declare(*this, values[i]);
    });
  }

  /// Sets values whose default depends on keys declared before: of use to a reader only.
  virtual void set_defaults(const std::function<void()>&) {}
  /// What is wrong between keys declared so far, `key` in the table being declared.
  virtual void reject(std::string_view /*key*/, const std::string& /*message*/) {}

 protected:
  virtual void one_of(const Key&, int& index, std::span<const std::string_view> names) = 0;
  virtual void section(const Key&, bool present, const std::function<void()>& contents) = 0;
  virtual void list(const Key&, std::size_t size, const std::function<void(std::size_t)>& item) = 0;
};

}  // namespace porosph
