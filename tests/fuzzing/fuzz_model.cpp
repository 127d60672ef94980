// The first byte chooses a learner, and the other bytes are a model of this learner as it is saved
// within a model file, whose checksum would refuse them. Wrong input may only end in an InputError.

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/config/module_loader.h>
#include <pharos/guiding/contract/learner.h>

namespace {

using namespace pharos;

/// Returns all learners with their default settings.
std::vector<Ref<Learner>> all_learners() {
  static const Registry registry = load_default_modules();
  std::vector<Ref<Learner>> learners;
  for (const std::string& name : registry.names(Learner::contract_name)) {
    BuildContext context{registry};
    ConfigNode resolved;
    learners.push_back(registry.build<Learner>(ConfigNode::scalar(name), context, resolved));
  }
  return learners;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<Ref<Learner>> learners = all_learners();
  if (size == 0) return -1;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  const std::shared_ptr<GuidingModel> model = learners[data[0] % learners.size()]->empty_model();
  try {
    load(in, *model);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
    return 0;
  }
  // What is accepted must be of use.
  model->info();
  model->density(Point3{0.1f, 0.2f, 0.3f});
  return 0;
}
