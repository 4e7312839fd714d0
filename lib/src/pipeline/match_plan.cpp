#include "tcm_icp/pipeline/match_plan.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/memory_budget.hpp"
#include "links/pair_search.hpp"
#include "links/pair_steps.hpp"
#include "pipeline/kept_set.hpp"
#include "pipeline/scan_checks.hpp"
#include "pipeline/scan_order.hpp"
#include "pipeline/scan_set.hpp"
#include "scans/scan_sight.hpp"
#include "scans/scan_steps.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string options_digest(const PipelineOptions& options, std::uint64_t seed) {
  const LinkSearchOptions search{options.formulation, options.lp, options.level};
  return step_key("plans", search_digest(search), prepared_digest("", {}, options.samples, seed)).digest;
}

void check_profile(const PipelineOptions& options) {
  if (options.profile == Profile::kRobust) return;
  throw InvalidOptions("--profile paper merges one scan after the other: it has no steps that can be done apart");
}

/// Numbers of scans such that pairs have numbers near one another (breadth first): what a block of pairs has to read.
std::vector<std::size_t> near_one_another(std::size_t num_scans, const ScanPairs& pairs) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::vector<std::size_t>> partners(num_scans);
  for (const auto& [a, b] : pairs) {
    partners[a].push_back(b);
    partners[b].push_back(a);
  }
  std::vector<std::size_t> number(num_scans, kNone), queue;
  for (std::size_t first = 0; first < num_scans; ++first) {
    if (number[first] != kNone) continue;
    std::size_t next = queue.size();
    number[first] = queue.size();
    queue.push_back(first);
    for (; next < queue.size(); ++next) {
      for (const std::size_t partner : partners[queue[next]]) {
        if (number[partner] != kNone) continue;
        number[partner] = queue.size();
        queue.push_back(partner);
      }
    }
  }
  return number;
}

fs::path plan_path(const StepStore& steps) { return steps.folder() / "plan.json"; }

PlannedGrid grid_of(const Json& json) { return {json.at("cell_m"), json.at("size")}; }
Json json_of(const PlannedGrid& grid) { return {{"cell_m", grid.cell_m}, {"size", grid.size}}; }

MatchPlan plan_of(const Json& json) {
  MatchPlan plan;
  plan.program = json.at("program");
  plan.options = json.at("options");
  json.at("scans").get_to(plan.scans);
  plan.coarse_m = json.at("coarse_m");
  plan.fine_m = json.at("fine_m");
  for (const auto& pair : json.at("pairs")) {
    plan.pairs.push_back({pair.at("a"), pair.at("b"), grid_of(pair.at("screening")), grid_of(pair.at("full"))});
    if (std::max(plan.pairs.back().a, plan.pairs.back().b) >= plan.scans.size()) throw BrokenRecord();
  }
  return plan;
}

}  // namespace

std::string sample_into(const StepStore& steps, const ScanInput& scan, const PipelineOptions& options,
                        const RunContext& context) {
  check_profile(options);
  context.report("reading", 0, 1);
  const SampledScan sample = sample_scan_once(steps, scan, options.sampling, options.outliers, context.seed,
                                              context.num_threads, ScanDetail::kViewpointClues);
  find_viewpoint_once(steps, sample, context.seed);
  return sample.digest;
}

MatchPlan plan_matches(const StepStore& steps, std::span<const ScanInput> inputs, const PipelineOptions& options,
                       const RunContext& context) {
  check_profile(options);
  if (inputs.size() < 2) throw InvalidOptions("pairs need at least two scans; name the files of all scans");
  check_inputs(inputs, InitialPoses(inputs.size()));
  const MemoryBudget budget(context);
  std::vector<SampledScan> sampled = read_scans(inputs, options, context, ScanDetail::kViewpointClues, &steps);
  refuse_twins(sampled);
  const bool as_listed = options.merge_order == MergeOrder::kFile;
  sampled = in_order(std::move(sampled), as_listed ? order_of_list(inputs.size()) : order_by_content(sampled));
  const Resolutions own = choose_resolutions(sampled, options.sampling, context.num_threads);
  const KeptSet kept = keep_resolutions(steps, sampled, options.sampling, own);
  const std::vector<PreparedScan> scans = prepare_scans(sampled, kept.resolutions, options.samples, context);
  const KeptSearches searches{&steps, prepared_digests(kept.base, kept.resolutions, options.samples, context.seed)};
  const LinkSearchOptions search{options.formulation, options.lp, options.level};
  const FirstPairs first = PairSearch(scans, search, context, searches).first_pairs();

  MatchPlan plan{program_identity(),
                 options_digest(options, context.seed),
                 {},
                 kept.resolutions.coarse_m,
                 kept.resolutions.fine_m,
                 {}};
  for (const auto& scan : sampled) plan.scans.push_back(scan.digest);
  const std::vector<std::size_t> number = near_one_another(sampled.size(), first.pairs);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> in_order_of_numbers;
  for (std::size_t k = 0; k < first.pairs.size(); ++k) {
    in_order_of_numbers[std::minmax(number[first.pairs[k].first], number[first.pairs[k].second])] = k;
  }
  for (const auto& [numbers, k] : in_order_of_numbers) {
    const auto& [screening, full] = first.grids[k];
    plan.pairs.push_back(
        {first.pairs[k].first, first.pairs[k].second, {screening.cell_m, screening.size}, {full.cell_m, full.size}});
  }
  return plan;
}

std::size_t match_block(const StepStore& steps, const MatchPlan& plan, std::size_t k, std::size_t num_blocks,
                        const PipelineOptions& options, const RunContext& context) {
  check_profile(options);
  if (k < 1 || k > num_blocks) {
    throw InvalidOptions("block " + std::to_string(k) + " of " + std::to_string(num_blocks) + ": there is none");
  }
  if (plan.program != program_identity()) {
    throw InvalidOptions(plan_path(steps).string() + " was made by another tcm-icp (" + plan.program +
                         "); run 'tcm-icp plan' again");
  }
  if (plan.options != options_digest(options, context.seed)) {
    throw InvalidOptions(plan_path(steps).string() +
                         " was made with other options; give the same, or run 'tcm-icp plan' again");
  }
  const std::size_t begin = plan.pairs.size() * (k - 1) / num_blocks, end = plan.pairs.size() * k / num_blocks;
  std::map<std::size_t, std::size_t> places;  // of the scans that are needed
  for (std::size_t i = begin; i < end; ++i) places[plan.pairs[i].a] = places[plan.pairs[i].b] = 0;
  std::vector<SampledScan> sampled;
  for (auto& [scan, place] : places) {
    place = sampled.size();
    context.report("reading", place, places.size());
    auto sample = find_sample(steps, {"samples", plan.scans[scan]});
    if (!sample) {
      throw InvalidInput(steps.folder().string() + ": the sample " + plan.scans[scan] +
                         " is not there; run 'tcm-icp sample' or 'tcm-icp plan' again");
    }
    sampled.push_back(std::move(*sample));
  }
  FirstPairs first;
  for (std::size_t i = begin; i < end; ++i) {
    const PlannedPair& pair = plan.pairs[i];
    first.pairs.emplace_back(places[pair.a], places[pair.b]);
    first.grids.push_back({{pair.screening.cell_m, pair.screening.size}, {pair.full.cell_m, pair.full.size}});
  }
  const auto viewpoints = find_viewpoints(sampled, context, &steps);
  std::vector<PreparedScan> scans = prepare_scans(sampled, {plan.coarse_m, plan.fine_m}, options.samples, context);
  make_sights(viewpoints, context, scans);
  const LinkSearchOptions search{options.formulation, options.lp, options.level};
  PairSearch(scans, search, context, {&steps, {}}).match(first);
  return end - begin;
}

void write_plan(const StepStore& steps, const MatchPlan& plan) {
  Json pairs = Json::array();
  for (const auto& pair : plan.pairs) {
    pairs.push_back(
        {{"a", pair.a}, {"b", pair.b}, {"screening", json_of(pair.screening)}, {"full", json_of(pair.full)}});
  }
  const Json json{{"program", plan.program}, {"options", plan.options}, {"coarse_m", plan.coarse_m},
                  {"fine_m", plan.fine_m},   {"scans", plan.scans},     {"pairs", pairs}};
  write_whole(plan_path(steps), json.dump() + "\n", steps.folder() / "unfinished");
}

MatchPlan read_plan(const StepStore& steps) {
  const fs::path path = plan_path(steps);
  std::ifstream in(path);
  if (!in) throw InputError(path, "", "there is no plan", "run 'tcm-icp plan' first");
  try {
    return plan_of(Json::parse(in));
  } catch (const Json::exception&) {
  } catch (const BrokenRecord&) {
  }
  throw InputError(path, "", "is no plan", "run 'tcm-icp plan' again");
}

}  // namespace tcm_icp
