#include <snug/base/section_check.h>
#include <snug/geometry/body_geometry.h>
#include <snug/geometry/formula.h>

#include <algorithm>
#include <cmath>

namespace snug::geometry {
namespace {
/// Maximum number of cells of a body, whose nodes deal.II and p4est number by 32 bits.
const double most_cells = 1e9;

/// Check that no rank has too many coarse cells, of which @p n_ranks ranks have a share each.
void require_coarse(const SectionCheck &section,
                    const double        cells,
                    const unsigned int  n_ranks,
                    const std::string  &entry,
                    const std::string  &value)
{
  const double most_of_rank = 4e6;
  section.require(cells <= std::min(n_ranks * most_of_rank, most_cells), entry, value,
                  "must give at most 4e6 cells per MPI rank if all bodies are boxes or rings "
                  "without refined cells, and at most 4e6 cells otherwise; 'Refinements' make more "
                  "cells");
}

void check_box(const SectionCheck       &section,
               const BodyMeshParameters &mesh,
               const unsigned int        n_ranks)
{
  section.require(!mesh.cells.empty(), "Box cells", "",
                  "must have " + to_text(section.dimension) +
                    " numbers separated by commas, one per dimension");
  double cells = 1.;
  for (const unsigned int n : mesh.cells)
    cells *= n;
  require_coarse(section, cells, n_ranks, "Box cells", to_text(mesh.cells));
}

void check_size(const SectionCheck       &section,
                const BodyMeshParameters &mesh,
                const double              cells,
                const unsigned int        n_ranks)
{
  const bool file = mesh.source == Source::file || mesh.source == Source::cad;
  require_coarse(section, cells, n_ranks, file ? "File" : "Cells",
                 file ? mesh.file : to_text(mesh.round_cells));
  section.require(mesh.refinements < 30 &&
                    cells * std::pow(2., section.dimension * mesh.refinements) <= most_cells,
                  "Refinements", to_text(mesh.refinements), "must give at most 1e9 cells");
}

void check_radius(const SectionCheck &section, const BodyMeshParameters &mesh, const double least)
{
  const std::string allowed = "must not lead to a negative x, the radius of axisymmetric models, "
                              "but leads to x = " +
                              to_text(least);
  const bool moved = !mesh.shift.empty() && mesh.shift[0] < 0.;
  const bool box   = mesh.source == Source::box && mesh.corner[0] < 0.;
  section.require(least >= 0. || !moved, "Shift", to_text(mesh.shift), allowed);
  section.require(least >= 0. || !box, "Box corner", to_text(mesh.corner), allowed);
  section.require(least >= 0., "Mesh", to_text(mesh.source), allowed);
}

/// Return the minimum x, the radius, over all vertices of the coarse cells (@p all), or over two
/// vertices of some cells. Return 0 if the minimum is negative only by round-off.
/// @throws InputError if a formula is not finite. All other points are checked when the mesh is
/// made.
template <int dim>
double least_radius(const BodyGeometry<dim> &geometry, const bool all)
{
  const double       some  = 4e6;
  const double       n     = geometry.n_coarse_cells();
  const unsigned int step  = all ? 1 : static_cast<unsigned int>(std::ceil(n / some));
  double             least = 0., largest = 0.;
  for (unsigned int cell = 0; cell < n; cell += step)
    for (unsigned int v = 0; v < 1 << dim; v += all ? 1 : (1 << dim) - 1)
      {
        dealii::Point<dim> unit;
        for (unsigned int d = 0; d < dim; ++d)
          unit[d] = v >> d & 1;
        const double x = geometry.position({cell, unit})[0];
        least          = std::min(least, x);
        largest        = std::max(largest, x);
      }
  const double round_off = 1e-10;
  return least < -round_off * largest ? least : 0.;
}

template <int dim>
void check_in(const SectionCheck       &section,
              const BodyMeshParameters &mesh,
              const bool                axisymmetric,
              const unsigned int        n_ranks)
{
  std::unique_ptr<BodyGeometry<dim>> geometry;
  double                             least = 0.;
  try
    {
      if (!mesh.refine_where.empty())
        Formula<dim>("Refine where", mesh.refine_where);
      geometry = make_geometry<dim>(mesh);
      if (axisymmetric || !mesh.warp.empty() || !mesh.curved_faces.empty())
        least = least_radius(*geometry, axisymmetric);
    }
  catch (const InputError &error)
    {
      throw section.placed(error, "Mesh", to_text(mesh.source));
    }
  check_size(section, mesh, geometry->n_coarse_cells(), n_ranks);
  if (axisymmetric)
    check_radius(section, mesh, least);
}
} // namespace

void BodyMeshParameters::check(const SectionCheck &section,
                               const bool          axisymmetric,
                               const unsigned int  n_ranks) const
{
  if (source == Source::box)
    check_box(section, *this, n_ranks);
  if (source == Source::file && !curved_faces.empty())
    {
      const auto &face = *curved_faces.begin();
      throw section.error("Curved faces", face.first + ": " + face.second,
                          "is for boxes; round boundaries of mesh files are recognized, with "
                          "'Surface = " +
                            face.first + ": smooth' at any angle between facets");
    }
  const bool is_cad = source == Source::cad;
  for (const auto &[entry, value] : {std::make_pair("Mesh regions", to_text(regions)),
                                     std::make_pair("Boundary names", to_text(boundary_numbers)),
                                     std::make_pair("Surface", to_text(surfaces))})
    section.require(!is_cad || value.empty(), entry, value,
                    "is for mesh files; the faces of CAD files have names, numbers and their own "
                    "surfaces");
  section.dimension == 2 ? check_in<2>(section, *this, axisymmetric, n_ranks)
                         : check_in<3>(section, *this, axisymmetric, n_ranks);
  section.require(local_refinements == 0 || !refine_where.empty(), "Refine where", refine_where,
                  "must be a formula of x, y, z when there are local refinements");
}
} // namespace snug::geometry
