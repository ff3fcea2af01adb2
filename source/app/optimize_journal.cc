#include <snug/app/optimize.h>
#include <snug/scene/read_scene.h>

#include <cstdint>
#include <fstream>
#include <sstream>

namespace snug::app {
template <int dim>
void Optimize<dim>::save_warm_start(const std::string &path) const
{
  std::ofstream file(path, std::ios::binary);
  for (const auto &start : warm_starts)
    {
      const std::uint64_t n = start.lambda.n_rows();
      file.write(reinterpret_cast<const char *>(&n), sizeof n);
      file.write(reinterpret_cast<const char *>(start.lambda.column(0)), n * sizeof(double));
      file.write(reinterpret_cast<const char *>(start.active.data()), start.active.size());
    }
  if (!file.flush())
    throw std::runtime_error("cannot write '" + path + "'");
}

template <int dim>
void Optimize<dim>::load_warm_start(const std::string &path)
{
  if (paired_anew)
    return;
  std::ifstream file(path, std::ios::binary);
  warm_starts.resize(workshop.n_load_cases());
  for (auto &start : warm_starts)
    {
      std::uint64_t n = 0;
      file.read(reinterpret_cast<char *>(&n), sizeof n);
      if (!file || n != workshop.solver->feti().n_owned())
        throw std::runtime_error("'" + path + "' does not belong to this scene");
      start.lambda = qp::MultiVector(n);
      start.active.resize(n);
      file.read(reinterpret_cast<char *>(start.lambda.column(0)), n * sizeof(double));
      file.read(reinterpret_cast<char *>(start.active.data()), n);
    }
  if (!file)
    throw std::runtime_error("'" + path + "' is incomplete");
}

template <int dim>
optimization::JournalSettings Optimize<dim>::journal_settings() const
{
  // Everything but where results go and when to stop decides the numbers.
  scene::Scene scene     = workshop.scene;
  scene.output_directory = "";
  scene.optimization.maximum_evaluations =
    optimization::OptimizationParameters().maximum_evaluations;
  std::ostringstream text;
  scene::print(scene, text);
  optimization::JournalSettings settings;
  settings.directory    = workshop.scene.output_directory;
  settings.fingerprint  = text.str();
  settings.restart      = restart;
  settings.communicator = workshop.context.communicator();
  settings.log = [this](const std::string &line) { workshop.context.out() << line << std::endl; };
  return settings;
}

#define SNUG_INSTANTIATE(dim)                                                                       \
  template void                          Optimize<dim>::save_warm_start(const std::string &) const; \
  template void                          Optimize<dim>::load_warm_start(const std::string &);       \
  template optimization::JournalSettings Optimize<dim>::journal_settings() const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
