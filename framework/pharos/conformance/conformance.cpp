#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <pharos/conformance/conformance.h>
#include <pharos/conformance/subjects.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/parallel.h>

namespace pharos::conformance {
namespace {

/// One case with its suite. Any thread can run it at any time.
struct Job {
  const PluginInfo* plugin;
  std::string settings;
  std::function<void(Suite&)> run;
  std::vector<Finding> findings = {};
  double seconds = 0;
};

Finding finding_of(const PluginInfo& plugin, std::string settings, Finding finding) {
  finding.contract = plugin.contract;
  finding.plugin = plugin.name;
  finding.module = plugin.module;
  finding.settings = std::move(settings);
  return finding;
}

/// Runs a job in isolation: while its thread waits for the job's own tasks, it takes no other job.
void run(Job& job, std::uint64_t seed) {
  const auto start = std::chrono::steady_clock::now();
  Suite suite(seed);
  std::optional<std::string> thrown;
  tbb::this_task_arena::isolate([&] {
    try {
      job.run(suite);
    } catch (const std::exception& e) {
      thrown = e.what();
    }
  });
  for (Finding& f : suite.findings()) {
    job.findings.push_back(finding_of(*job.plugin, job.settings, std::move(f)));
  }
  if (thrown) {
    job.findings.push_back(finding_of(
        *job.plugin, job.settings,
        {.check = "exception", .verdict = Verdict::failed, .detail = one_line(*thrown)}));
  }
  job.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns the suite of a contract whose plugins are tested without partners; empty if there is
/// none. `s` must outlive the suite.
std::function<void(Suite&)> suite_of(const Registry& registry, const Subject& s) {
  const auto as = [&s]<class C>() { return std::static_pointer_cast<const C>(s.component); };
  const std::string& contract = s.plugin->contract;
  if (contract == Bsdf::contract_name) {
    return [c = as.operator()<Bsdf>()](Suite& suite) { check_bsdf(*c, suite); };
  }
  if (contract == Emitter::contract_name) {
    return [c = as.operator()<Emitter>()](Suite& suite) { check_emitter(c, suite); };
  }
  if (contract == Sensor::contract_name) {
    return [c = as.operator()<Sensor>()](Suite& suite) { check_sensor(*c, suite); };
  }
  if (contract == Filter::contract_name) {
    return [c = as.operator()<Filter>()](Suite& suite) { check_filter(*c, suite); };
  }
  if (contract == Texture::contract_name) {
    return [c = as.operator()<Texture>()](Suite& suite) { check_texture(*c, suite); };
  }
  if (contract == Sampler::contract_name) {
    return [c = as.operator()<Sampler>()](Suite& suite) { check_sampler(*c, suite); };
  }
  if (contract == PhaseFunction::contract_name) {
    return [c = as.operator()<PhaseFunction>()](Suite& suite) { check_phase_function(*c, suite); };
  }
  if (contract == Medium::contract_name) {
    return [c = as.operator()<Medium>()](Suite& suite) { check_medium(*c, suite); };
  }
  if (contract == Shape::contract_name) {
    return [c = as.operator()<Shape>()](Suite& suite) { check_shape(c, suite); };
  }
  if (contract == Integrator::contract_name) {
    return [c = as.operator()<Integrator>()](Suite& suite) { check_integrator(*c, suite); };
  }
  if (contract == Termination::contract_name) {
    return [&registry, &s](Suite& suite) { check_termination(registry, s, suite); };
  }
  return {};
}

/// All plugins of a registry with their cases, and the jobs for the selected plugins.
class Plan {
 public:
  Plan(const Registry& registry, const Selection& selection)
      : registry_(registry), selection_(selection) {
    check_selection();
    for_each_plugin([&](const PluginInfo& plugin) {
      const bool guides = is_guiding(plugin);
      if (is_selected(plugin) || guides)
        cases_[&plugin] = cases_of(registry, plugin, folder_.path());
    });
    for_each_plugin([&](const PluginInfo& plugin) {
      if (is_selected(plugin)) add_buildable(plugin);
      if (plugin.contract == Guider::contract_name) {
        add_guider(plugin);
      } else if (is_selected(plugin)) {
        plugin.contract == Learner::contract_name ? add_learner(plugin) : add_suites(plugin);
      }
    });
    if (jobs.empty()) throw InputError("there is no plugin to test: " + selection_text());
  }

  std::vector<Job> jobs;

 private:
  template <class Use>
  void for_each_plugin(Use&& use) const {
    for (const std::string& contract : registry_.contracts()) {
      for (const std::string& name : registry_.names(contract))
        use(*registry_.find(contract, name));
    }
  }

  static bool is_guiding(const PluginInfo& plugin) {
    return plugin.contract == Guider::contract_name || plugin.contract == Learner::contract_name;
  }

  bool is_selected(const PluginInfo& plugin) const {
    const auto names = [&](const std::string& n) {
      return n == plugin.name || n == plugin.contract;
    };
    return (selection_.module.empty() || selection_.module == plugin.module) &&
           (selection_.names.empty() ||
            std::any_of(selection_.names.begin(), selection_.names.end(), names));
  }

  /// Throws InputError for names that do not exist.
  void check_selection() const {
    std::vector<std::string> names = registry_.contracts(), modules;
    for_each_plugin([&](const PluginInfo& plugin) {
      names.push_back(plugin.name);
      modules.push_back(plugin.module);
    });
    const auto check = [](const std::string& wanted, const std::vector<std::string>& known,
                          const char* what) {
      if (std::find(known.begin(), known.end(), wanted) != known.end()) return;
      throw InputError(
          fmt::format("there is no {} '{}'{}", what, wanted, suggestion(wanted, known)));
    };
    for (const std::string& name : selection_.names) check(name, names, "contract or plugin");
    if (!selection_.module.empty()) check(selection_.module, modules, "module with plugins");
  }

  std::string selection_text() const {
    if (selection_.names.empty()) return "none is registered";
    const std::string names = quoted_list(selection_.names);
    if (selection_.module.empty()) return names + " has none";
    return fmt::format("the module '{}' has none of {}", selection_.module, names);
  }

  void add_finding(const PluginInfo& plugin, std::string settings, Finding finding) {
    Job job{&plugin, {}, {}};
    job.findings.push_back(finding_of(plugin, std::move(settings), std::move(finding)));
    jobs.push_back(std::move(job));
  }

  void add_buildable(const PluginInfo& plugin) {
    const Cases& cases = cases_.at(&plugin);
    Finding finding{.check = "buildable", .detail = fmt::format("{} cases", cases.subjects.size())};
    for (const std::string& reason : cases.left_out) finding.detail += "; left out: " + reason;
    if (!cases.broken.empty()) {
      finding.verdict = Verdict::failed;
      finding.detail = "an example cannot be built: " + cases.broken.front();
    } else if (cases.subjects.empty()) {
      finding.verdict = Verdict::failed;
      finding.detail =
          "it cannot be built from its defaults; state settings that can by "
          "s.example(\"{ ... }\") in describe(). " +
          (cases.left_out.empty() ? "" : cases.left_out.front());
    }
    finding.detail = one_line(finding.detail, 1000);
    add_finding(plugin, {}, std::move(finding));
  }

  void add_suites(const PluginInfo& plugin) {
    const std::vector<Subject>& subjects = cases_.at(&plugin).subjects;
    for (const Subject& subject : subjects) {
      auto suite = suite_of(registry_, subject);
      if (!suite) {
        return add_finding(plugin, {},
                           {.check = "suite",
                            .verdict = Verdict::not_applicable,
                            .detail = "the contract has no suite of its own"});
      }
      jobs.push_back({&plugin, subject.settings, std::move(suite)});
    }
  }

  /// Returns whether the guider can sample what the learner learns.
  static bool suit(const Subject& guider, const Subject& learner) {
    const auto model = static_cast<const Learner&>(*learner.component).empty_model();
    return static_cast<const Guider&>(*guider.component).find(*model) != nullptr;
  }

  /// Returns the cases of all plugins of a contract whose first subject is a partner.
  template <class IsPartner>
  std::vector<const Cases*> partners(std::string_view contract, IsPartner&& is_partner) const {
    std::vector<const Cases*> all;
    for_each_plugin([&](const PluginInfo& plugin) {
      if (plugin.contract != contract || cases_.at(&plugin).subjects.empty()) return;
      if (is_partner(cases_.at(&plugin).subjects.front())) all.push_back(&cases_.at(&plugin));
    });
    return all;
  }

  void add_no_partner(const Subject& subject, const char* partner) {
    add_finding(*subject.plugin, subject.settings,
                {.check = "suite",
                 .verdict = Verdict::not_applicable,
                 .detail = fmt::format("no {} for its model is loaded", partner)});
  }

  /// Adds every case of the guider with the first case of each learner of its model. The other
  /// cases of a learner are tested with the first case of one guider. If only a guider or only a
  /// learner is selected, the other takes part with its first case alone.
  void add_guider(const PluginInfo& plugin) {
    const std::vector<Subject>& guiders = cases_.at(&plugin).subjects;
    if (guiders.empty()) return;
    const auto all = partners(Learner::contract_name, [&](const Subject& learner) {
      return suit(guiders.front(), learner);
    });
    if (all.empty() && is_selected(plugin)) add_no_partner(guiders.front(), "learner");
    for (const Cases* learners : all) {
      const std::vector<Subject>& subjects = learners->subjects;
      const bool guider_selected = is_selected(plugin),
                 learner_selected = is_selected(*subjects.front().plugin),
                 in_full = learner_selected && guider_of(subjects.front()) == &guiders.front();
      if (guider_selected || learner_selected) add_pair(guiders.front(), subjects.front());
      for (std::size_t i = 1; guider_selected && i < guiders.size(); ++i) {
        add_pair(guiders[i], subjects.front());
      }
      for (std::size_t i = 1; in_full && i < subjects.size(); ++i) {
        add_pair(guiders.front(), subjects[i]);
      }
    }
  }

  /// Returns the first case of the guider with which a learner is tested in all its cases: the
  /// first one of its module, or else of any module. Null: no guider knows its model.
  const Subject* guider_of(const Subject& learner) const {
    const auto guiders = partners(Guider::contract_name,
                                  [&](const Subject& guider) { return suit(guider, learner); });
    for (const Cases* cases : guiders) {
      const Subject& first = cases->subjects.front();
      if (first.plugin->module == learner.plugin->module) return &first;
    }
    return guiders.empty() ? nullptr : &guiders.front()->subjects.front();
  }

  void add_pair(const Subject& guider, const Subject& learner) {
    std::string settings = fmt::format("{} with the learner {} {}", guider.settings,
                                       learner.plugin->name, learner.settings);
    jobs.push_back({guider.plugin, std::move(settings),
                    [&](Suite& suite) { check_guider(registry_, guider, learner, suite); }});
  }

  void add_learner(const PluginInfo& plugin) {
    const std::vector<Subject>& learners = cases_.at(&plugin).subjects;
    if (learners.empty()) return;
    const Subject* guider = guider_of(learners.front());
    if (guider == nullptr) return add_no_partner(learners.front(), "guider");
    for (const Subject& learner : learners) {
      jobs.push_back({&plugin, learner.settings, [&, guider](Suite& suite) {
                        check_learner(registry_, learner, *guider, suite);
                      }});
    }
  }

  const Registry& registry_;
  const Selection& selection_;
  ExampleFolder folder_;
  std::map<const PluginInfo*, Cases> cases_;
};

}  // namespace

Report check_plugins(const Registry& registry, const Selection& selection, const Options& options) {
  Plan plan(registry, selection);
  parallel_for(plan.jobs.size(), [&](std::size_t i) {
    if (plan.jobs[i].run) run(plan.jobs[i], options.seed);
  });
  Report report;
  for (Job& job : plan.jobs) {
    report.seconds[{job.plugin->contract, job.plugin->name}] += job.seconds;
    for (Finding& f : job.findings) report.findings.push_back(std::move(f));
  }
  finish(report, options.family_level);
  return report;
}

}  // namespace pharos::conformance
