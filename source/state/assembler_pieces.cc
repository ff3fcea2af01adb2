#include <snug/state/assembler.h>
#include <snug/state/thermal.h>

#include <algorithm>

namespace snug::state {
template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::piece_field(const Piece &piece,
                                                           const Field &field) const
{
  if (piece.tetrahedron == nullptr)
    return cell_field(piece.cell, field);
  Nodes result;
  for (const unsigned int node : piece.tetrahedron->nodes)
    result.push_back(field[node]);
  return result;
}

template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::piece_values(unsigned int i, const double *u) const
{
  const Piece &piece = pieces[i];
  if (piece.tetrahedron == nullptr)
    return cell_values(piece.cell, u);
  Nodes result;
  for (const unsigned int slot : cell_reach[piece.cell].slots())
    {
      result.emplace_back();
      std::copy_n(u + dim * slot, dim, result.back().begin_raw());
    }
  return result;
}

/// All cells of a tetrahedron are in one subdomain.
template <int dim>
void Assembler<dim>::collect_pieces()
{
  for (unsigned int i = 0; i < subdomain.cells.size(); ++i)
    {
      const unsigned int cell        = subdomain.cells[i];
      const auto        *tetrahedron = the_element.is_mixed() ? nullptr : mesh.tetrahedron(cell);
      if (tetrahedron == nullptr || tetrahedron->cells[0] == cell)
        pieces.push_back({i, tetrahedron, {}});
    }
}

/// Compute the matrix of a piece at the unknowns of its slots.
template <int dim>
void Assembler<dim>::compute_stiffness(const Piece         &piece,
                                       const Field         &positions,
                                       std::vector<double> &matrix) const
{
  const Nodes X = piece_field(piece, positions);
  if (piece.tetrahedron != nullptr)
    {
      the_element.stiffness_of_tetrahedron(X, material(piece.cell), matrix);
      return;
    }
  the_element.stiffness(X, material(piece.cell), matrix);
  // condense() also adapts the size, because m slots may be more than the nodes of the cell.
  cell_reach[piece.cell].condense(matrix);
}

template <int dim>
elasticity::ThermalStrain<dim> Assembler<dim>::piece_strain(unsigned int i,
                                                            unsigned int load_case) const
{
  return state::thermal_strain<dim>(loads(load_case), material(pieces[i].cell),
                                    piece_field(i, mesh.reference_positions()));
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template void                  Assembler<dim>::collect_pieces();                                 \
  template Assembler<dim>::Nodes Assembler<dim>::piece_field(const Piece &, const Field &) const;  \
  template Assembler<dim>::Nodes Assembler<dim>::piece_values(unsigned int, const double *) const; \
  template void                  Assembler<dim>::compute_stiffness(const Piece &, const Field &,   \
                                                                   std::vector<double> &) const;   \
  template elasticity::ThermalStrain<dim> Assembler<dim>::piece_strain(unsigned int, unsigned int) \
    const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
