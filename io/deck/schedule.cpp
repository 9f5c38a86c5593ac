#include "deck/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/geometry.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

class Scheduler {
 public:
  Scheduler(Builder& builder, const ReadOptions& options) : builder_(builder) {
    for (const auto& keyword : options.ignored_keywords) {
      const std::string squeezed = squeeze(keyword);
      ignored_.push_back(squeezed.starts_with('*') ? squeezed.substr(1) : squeezed);
    }
  }

  std::vector<Task> run(std::vector<Block>& blocks) {
    for (auto& block : blocks) take(block);
    finish();
    return std::move(tasks_);
  }

 private:
  void take(Block& block);
  void take_structure(Block& block);
  void begin_instance(const Block& block);
  void begin_or_end_step(const Block& block);
  bool accepted(Block& block, const KeywordRule& rule);
  bool is_structure(const Block& block) const;
  void add(Block& block);
  void add_checked(Block& block);
  void unknown(const Block& block);
  void finish();

  Builder& builder_;
  std::vector<std::string> ignored_;
  std::vector<Task> tasks_;
  std::map<std::string, std::vector<Block*>> parts_;
  const Block* part_ = nullptr;  // *PART, *ASSEMBLY, *INSTANCE, *STEP that is open
  const Block* assembly_ = nullptr;
  const Block* instance_ = nullptr;
  const Block* step_ = nullptr;
  Scope* scope_ = &builder_.scopes.front();
  std::string parent_;  // keyword whose options may follow
  Phase parent_phase_ = Phase::definitions;
  bool parent_refused_ = false;
  bool step_refused_ = false;  // the *STEP line itself was refused: nothing in the step is run
};

bool Scheduler::is_structure(const Block& block) const {
  static const std::vector<std::string> words{"PART", "ENDPART", "INSTANCE", "ENDINSTANCE", "ASSEMBLY", "ENDASSEMBLY"};
  return std::find(words.begin(), words.end(), block.keyword) != words.end();
}

void Scheduler::take(Block& block) {
  if (is_structure(block)) {
    take_structure(block);
  } else if (part_ != nullptr) {
    parts_[part_->value("NAME")].push_back(&block);
  } else {
    add(block);
  }
}

void Scheduler::add(Block& block) {
  const std::size_t errors = builder_.diagnostics.number_of_errors();
  add_checked(block);
  if (builder_.diagnostics.number_of_errors() > errors && step_ != nullptr) builder_.refused_steps.insert(step_);
}

void Scheduler::take_structure(Block& block) {
  const KeywordRule& rule = *find_keyword(block.keyword);
  if (!check_parameters(rule, block, builder_.diagnostics)) builder_.poison(block);
  const auto open = [&](const Block*& mark) {
    if (mark != nullptr) {
      builder_.error(
          block, block.location,
          fmt::format("the *{0} of line {1} has no *END {0} yet; close it first", rule.keyword, mark->location.line));
    }
    mark = &block;
  };
  const auto close = [&](const Block*& mark) {
    if (mark == nullptr)
      builder_.error(block, block.location, "there is nothing to end; remove this line or add its beginning");
    mark = nullptr;
  };
  if (block.keyword == "PART") {
    open(part_);
    parts_[block.value("NAME")];  // also a part without anything in it, as Abaqus/CAE writes analytical ones
  }
  if (block.keyword == "ENDPART") close(part_);
  if (block.keyword == "ASSEMBLY") open(assembly_);
  if (block.keyword == "ENDASSEMBLY") close(assembly_);
  if (block.keyword == "INSTANCE") {
    open(instance_);
    begin_instance(block);
  }
  if (block.keyword == "ENDINSTANCE") {
    close(instance_);
    scope_ = &builder_.scopes.front();
  }
}

void Scheduler::begin_instance(const Block& block) {
  builder_.scopes.emplace_back();
  scope_ = &builder_.scopes.back();
  scope_->prefix = block.value("NAME") + ".";
  auto& instances = builder_.model.instances;
  if (instances.empty()) {  // the assembly has nodes and elements of its own
    instances.emplace_back();
    builder_.scopes.front().instance = 0;
  }
  scope_->instance = static_cast<std::int32_t>(instances.size());
  instances.push_back({block.value("NAME"), block.value("PART")});
  if (block.has("NSET")) scope_->node_set = builder_.node_set_row(block.value("NSET"));
  if (block.has("ELSET")) scope_->element_set = builder_.element_set_row(block.value("ELSET"));
  if (!block.lines.empty()) {
    Row row(builder_, block, block.lines[0]);
    for (int i = 0; i < 3; ++i) scope_->translation[i] = row.real_or(i, 0.0, "translation");
    row.at_most(3);
  }
  if (block.lines.size() > 1) {
    Row row(builder_, block, block.lines[1]);
    read_rotation(row, scope_->centre, scope_->rotation);
  }
  const auto part = parts_.find(block.value("PART"));
  if (part == parts_.end()) {
    std::vector<std::string> names;
    for (const auto& [name, blocks] : parts_) names.push_back(name);
    if (block.has("PART")) {
      builder_.error(
          block, block.location,
          fmt::format("part {} is not defined{}", block.value("PART"), did_you_mean(block.value("PART"), names)));
    }
    return;
  }
  for (Block* inside : part->second) add(*inside);
}

namespace {

/// Whether a squeezed keyword is one of `parents`, "A or B".
bool may_follow(std::string_view parents, std::string_view keyword) {
  constexpr std::string_view either = " or ";
  for (std::size_t begin = 0;;) {
    const auto end = parents.find(either, begin);
    if (squeeze(parents.substr(begin, end - begin)) == keyword) return true;
    if (end == std::string_view::npos) return false;
    begin = end + either.size();
  }
}

}  // namespace

void Scheduler::unknown(const Block& block) {
  const std::string guess = nearest(block.keyword, keywords());
  const std::string cure = guess.empty() ? fmt::format("remove it or run with --ignore \"{}\"", block.written)
                                         : "did you mean *" + guess + "?";
  builder_.error(block, block.location, "this keyword is unknown or not supported; " + cure);
}

void Scheduler::add_checked(Block& block) {
  if (std::find(ignored_.begin(), ignored_.end(), block.keyword) != ignored_.end()) {
    builder_.warning(block, block.location, "ignored as requested, with its data lines");
    if (step_ != nullptr) builder_.refused_steps.insert(step_);
    parent_ = block.keyword;
    parent_refused_ = true;
    return;
  }
  const KeywordRule* rule = find_keyword(block.keyword);
  if (rule == nullptr) {
    unknown(block);
    parent_ = "?";
    parent_refused_ = true;
    return;
  }
  if (!accepted(block, *rule)) {
    if (rule->parent.empty()) parent_refused_ = true;
    return;
  }
  if (rule->parent.empty()) {
    parent_ = block.keyword;
    parent_phase_ = rule->phase;
    parent_refused_ = false;
  }
  const bool skipped = step_refused_ && rule->phase == Phase::history;
  if (block.keyword == "STEP" || block.keyword == "ENDSTEP") begin_or_end_step(block);
  if (!rule->warning.empty()) builder_.warning(block, block.location, rule->warning);
  // An option of what belongs to the step does too.
  const bool of_step = step_ != nullptr && (rule->phase == Phase::constraints || (!rule->parent.empty() && parent_phase_ == Phase::history));
  const Phase phase = of_step ? Phase::history : rule->phase;
  const bool in_step = step_ != nullptr && phase == Phase::history;
  if (rule->handler != nullptr && !skipped)
    tasks_.push_back({&block, rule, scope_, phase, in_step || block.keyword == "ENDSTEP"});
}

bool Scheduler::accepted(Block& block, const KeywordRule& rule) {
  if (!check_parameters(rule, block, builder_.diagnostics)) {
    builder_.poison(block);
    if (rule.parent.empty()) parent_ = block.keyword;
    if (block.keyword == "STEP") begin_or_end_step(block);
    step_refused_ = step_refused_ || block.keyword == "STEP";
    return false;
  }
  if (!rule.parent.empty() && !may_follow(rule.parent, parent_)) {
    if (parent_ != "?") {
      builder_.error(block, block.location, fmt::format("it must follow *{}; move it there", rule.parent));
    }
    return false;
  }
  if (!rule.parent.empty() && parent_refused_) return false;
  if (rule.place == Place::step && step_ == nullptr) {
    builder_.error(block, block.location, "it belongs inside a *STEP; move it between *STEP and *END STEP");
    return false;
  }
  if (rule.place == Place::model && step_ != nullptr && block.keyword != "STEP") {
    builder_.error(block, block.location, "it cannot stand inside a *STEP; move it before the first *STEP");
    return false;
  }
  return true;
}

void Scheduler::begin_or_end_step(const Block& block) {
  if (block.keyword == "ENDSTEP") {
    step_ = nullptr;
    step_refused_ = false;
    return;
  }
  if (step_ != nullptr) {
    builder_.error(*step_, step_->location,
                   fmt::format("*END STEP is missing before the *STEP of line {}; add it", block.location.line));
  }
  step_ = &block;
}

void Scheduler::finish() {
  if (step_ != nullptr) builder_.error(*step_, step_->location, "*END STEP is missing; add it at the end of the step");
  for (const Block* open : {part_, assembly_, instance_}) {
    if (open != nullptr) {
      builder_.error(*open, open->location, fmt::format("*END {} is missing; add it", open->written));
    }
  }
}

}  // namespace

std::vector<Task> schedule(Builder& builder, std::vector<Block>& blocks, const ReadOptions& options) {
  return Scheduler(builder, options).run(blocks);
}

}  // namespace balocco::deck
