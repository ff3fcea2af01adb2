#ifndef snug_mesh_coarse_description_h
#define snug_mesh_coarse_description_h

#include <snug/base/deal_ii_compat.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <deal.II/grid/tria_description.h>

namespace snug::mesh {
/// Return a description of @p triangulation without cells, to which coarse cells can be added.
template <int dim>
dealii::TriangulationDescription::Description<dim, dim>
coarse_description(const dealii::parallel::fullydistributed::Triangulation<dim> &triangulation)
{
  dealii::TriangulationDescription::Description<dim, dim> description;
  description.comm      = deal_ii_compat::communicator(triangulation);
  description.settings  = dealii::TriangulationDescription::Settings::default_setting;
  description.smoothing = triangulation.get_mesh_smoothing();
  description.cell_infos.resize(1);
  return description;
}

/// Add a cell without children and with straight edges. Its vertices and boundaries are to be set.
/// Cells must be added in the order of @p id.
template <int dim>
void add_cell(const unsigned int                                       id,
              const unsigned int                                       body,
              const unsigned int                                       rank,
              dealii::TriangulationDescription::Description<dim, dim> &description)
{
  description.coarse_cell_index_to_coarse_cell_id.push_back(id);
  description.coarse_cells.emplace_back(1u << dim);
  // Refined cells inherit the material id. Regions are found from coarse cells instead.
  description.coarse_cells.back().material_id = body;
  dealii::TriangulationDescription::CellData<dim> info;
  info.id                 = dealii::CellId(id, {}).template to_binary<dim>();
  info.subdomain_id       = rank;
  info.level_subdomain_id = dealii::numbers::artificial_subdomain_id;
  info.manifold_id        = dealii::numbers::flat_manifold_id;
  info.manifold_line_ids.fill(dealii::numbers::flat_manifold_id);
  info.manifold_quad_ids.fill(dealii::numbers::flat_manifold_id);
  description.cell_infos[0].push_back(info);
}
} // namespace snug::mesh

#endif
