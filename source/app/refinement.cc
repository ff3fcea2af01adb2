#include <snug/app/refinement.h>
#include <snug/cad/import_cad.h>
#include <snug/mesh/refined_cells.h>

namespace snug::app {
void Refinement::divide(const unsigned int body, const dealii::CellId &cell)
{
  mesh::refine(cell, divided[body]);
}

void Refinement::halve(const unsigned int                   body,
                       const unsigned int                   after,
                       const std::vector<dealii::Point<3>> &places)
{
  auto &of_body = halved[body];
  of_body.resize(after + 1);
  of_body.back().insert(of_body.back().end(), places.begin(), places.end());
}

unsigned int Refinement::n_halvings(const unsigned int body) const
{
  const auto found = halved.find(body);
  return found == halved.end() ? 0 : found->second.size();
}

bool Refinement::remesh(scene::Scene &scene, RunContext &context) const
{
  bool any = false;
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      auto      &mesh   = scene.bodies[b].mesh;
      const auto found  = halved.find(b);
      const auto wanted = found == halved.end() ? Halvings() : found->second;
      if (mesh.halved == wanted)
        continue;
      auto parameters   = mesh;
      parameters.halved = wanted;
      parameters.imported =
        cad::import_cad(parameters, scene.dimension,
                        scene.output_directory + "/cad/" + scene.bodies[b].name, context);
      mesh = std::move(parameters);
      any  = true;
    }
  return any;
}

template <int dim>
std::set<dealii::CellId> Refinement::cells(const geometry::CoarseCells<dim> &coarse) const
{
  std::set<dealii::CellId> result;
  for (const auto &[body, ids] : divided)
    for (const auto &id : ids)
      result.insert(coarse.in_all(body, id));
  return result;
}

template std::set<dealii::CellId> Refinement::cells(const geometry::CoarseCells<2> &) const;
template std::set<dealii::CellId> Refinement::cells(const geometry::CoarseCells<3> &) const;
} // namespace snug::app
