#ifndef snug_mortar_mortar_coupling_h
#define snug_mortar_mortar_coupling_h

#include <snug/mortar/segment_points.h>

#include <deal.II/base/table.h>

namespace snug::mortar {
/**
 * Integrals over the covered part of a slave face, the part opposite to
 * the given master faces, of its shape functions N_j and those of the
 * master faces, N_k.
 */
template <typename Number>
struct FaceIntegrals
{
  std::vector<Number>                   slave;        ///< int N_j
  dealii::Table<2, Number>              slave_slave;  ///< int N_j N_l
  std::vector<dealii::Table<2, Number>> slave_master; ///< int N_j N_k
};

/**
 * The same with multiplier functions psi_j, which sum to 1:
 *   biorthogonal, psi_j = sum_l A_jl N_l with A = diag(d) m^-1,
 *   d_j = int N_j, m_jl = int N_j N_l, so int psi_j N_l = d_j delta_jl and
 *   int psi_j = d_j (Wohlmuth, SIAM J. Numer. Anal. 38, 2000; on partly
 *   covered faces Popp, Seitz, Gee, Wall, Comput. Methods Appl. Mech.
 *   Engrg. 264, 2013);
 *   or standard, psi_j = N_j, for faces covered too little for m^-1.
 */
template <typename Number>
struct FaceCoupling
{
  std::vector<Number>                   multiplier;        ///< int psi_j
  dealii::Table<2, Number>              multiplier_slave;  ///< psi_j N_l
  std::vector<dealii::Table<2, Number>> multiplier_master; ///< psi_j N_k
};

template <int dim, typename Number>
FaceIntegrals<Number> integrate(const SegmentQuadrature<dim>              &quadrature,
                                const FaceNodes<dim, Number>              &slave,
                                const std::vector<FaceNodes<dim, Number>> &masters);

template <typename Number>
FaceCoupling<Number> couple(const FaceIntegrals<Number> &integrals, bool biorthogonal);

/// The transpose of the derivative of couple(): from the gradient of a
/// scalar with respect to the coupling, that to the integrals.
FaceIntegrals<double> couple_transpose(const FaceIntegrals<double> &integrals,
                                       bool                         biorthogonal,
                                       const FaceCoupling<double>  &gradient);
} // namespace snug::mortar

#endif
