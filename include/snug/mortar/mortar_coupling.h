#ifndef snug_mortar_mortar_coupling_h
#define snug_mortar_mortar_coupling_h

#include <snug/mortar/segment_points.h>

#include <deal.II/base/table.h>

namespace snug::mortar {
/**
 * Integrals over the covered part of a slave face, the part opposite to
 * the given master faces, of its shape functions N_j and those of the
 * master faces, N_k, and of the offset between the true surfaces beyond
 * that of the faces, delta = delta_master - delta_slave.
 */
template <typename Number>
struct FaceIntegrals
{
  std::vector<Number>                   slave;        ///< int N_j
  dealii::Table<2, Number>              slave_slave;  ///< int N_j N_l
  std::vector<dealii::Table<2, Number>> slave_master; ///< int N_j N_k
  /// int (N_j N_k)^p, p the degree: never negative
  std::vector<dealii::Table<2, Number>> weights;
  dealii::Table<2, Number>              offset; ///< int N_j delta_d
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
  dealii::Table<2, Number>              multiplier_offset; ///< psi_j delta_d
};

/// The offset of a face at @p xi, differentiated with it.
template <int dim, typename Number>
std::array<Number, dim> offset_at(const FaceNodes<dim, Number>              &offsets,
                                  const faces::FaceCoordinates<dim, Number> &xi);

template <int dim, typename Number>
FaceIntegrals<Number> integrate(const SegmentQuadrature<dim>               &quadrature,
                                const MortarFace<dim, Number>              &slave,
                                const std::vector<MortarFace<dim, Number>> &masters);

template <typename Number>
FaceCoupling<Number> couple(const FaceIntegrals<Number> &integrals, bool biorthogonal);

/// The transpose of the derivative of couple(): from the gradient of a
/// scalar with respect to the coupling, that to the integrals but for the
/// weights, of which there is none.
FaceIntegrals<double> couple_transpose(const FaceIntegrals<double> &integrals,
                                       bool                         biorthogonal,
                                       const FaceCoupling<double>  &gradient);
} // namespace snug::mortar

#endif
