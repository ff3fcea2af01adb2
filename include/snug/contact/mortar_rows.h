#ifndef snug_contact_mortar_rows_h
#define snug_contact_mortar_rows_h

#include <snug/contact/mortar_normals.h>
#include <snug/contact/row_group.h>
#include <snug/mortar/mortar_coupling.h>
#include <snug/mortar/multiplier_nodes.h>

#include <algorithm>

namespace snug::contact {
/**
 * This class provides the mortar contact of one pair. The pressure sum_i p_i psi_i n_i acts between
 * the faces. psi_i are the functions of the multiplier nodes (FaceCoupling, MultiplierNodes), and
 * n_i are the MortarNormals at these nodes. Row i is the mean gap weighted by
 * psi_i:
 *   c_l = n_i D_il / a_i,  c_k = -n_i (M_ik + dM_ik) / a_i,
 *   gap = n_i . int psi_i (x_master - x_slave) / a_i,
 *   D_il = int psi_i N_l,  M_ik = int psi_i N_k,  a_i = int psi_i.
 * The integrals cover the part of the slave side that lies opposite to the master side, so that the
 * force of row i over the area a_i is p_i. Positions in the gap are those of the true surfaces. dM
 * frees the row of its moment (MomentCorrection) with the weights int (N_i N_k)^p, where p is the
 * degree. Hanging nodes are replaced by their masters.
 *
 * The constructor fixes which faces lie opposite to each other, which nodes carry multipliers, and
 * the MultiplierFunctions of the faces. Cut faces, weights, normals and gaps follow the positions.
 * Derivatives are exact. Where the end of one side lies on an edge or corner of the other, the
 * derivatives are those of moves that keep the slave face covered. Rows whose gap is beyond the
 * search distance of the pair are left out.
 */
template <int dim>
class MortarRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  explicit MortarRows(const PairGeometry<dim> &pair);

  const std::vector<unsigned int> &slaves() const override { return multipliers.nodes; }
  std::vector<DependentMultiplier> dependent_multipliers() const override;
  std::vector<Row<dim>>            rows(const Field &positions) const override;
  std::vector<Row<dim>>            row_derivatives(const Field &positions,
                                                   const Field &velocity) const override;
  void                             add_gradient(const Field                       &positions,
                                                const std::vector<RowSlopes<dim>> &slopes,
                                                Field                             &gradient) const override;
  std::vector<double>              areas(const Field &positions) const override;
  std::vector<double>              area_derivatives(const Field &positions,
                                                    const Field &velocity) const override;
  void                             add_area_gradient(const Field               &positions,
                                                     const std::vector<double> &factors,
                                                     Field                     &gradient) const override;

private:
  struct SlaveFace
  {
    unsigned int                face;    ///< index of the surface face
    std::vector<unsigned int>   masters; ///< indices of the opposite surface faces
    mortar::MultiplierFunctions functions;
    /// rows with their shares of the multiplier function of each node
    std::vector<mortar::MultiplierNodes::Shares> shares = {};
  };

  template <typename Number>
  using Points = faces::PointField<dim, Number>;

  /// Sums of row i over the slave faces. The coefficients are a_i times those of the row, without
  /// n_i and dM. The weights are those of the moment correction. Both have one entry per node of
  /// the row. The offset is the integral of psi_i (x_master - x_slave), and the area is a_i.
  template <typename Number>
  struct RowSum
  {
    std::vector<Number>            coefficients, weights;
    dealii::Tensor<1, dim, Number> offset;
    Number                         area = 0.;

    explicit RowSum(unsigned int n_nodes) : coefficients(n_nodes), weights(n_nodes) {}
  };

  const mesh::Surface<dim>              &surface;
  const faces::FaceShape<dim>           &shape;
  mortar::SegmentQuadrature<dim>         quadrature;
  PairFaces                              sides;
  std::vector<SlaveFace>                 faces;
  faces::HeldDirections<dim>             held;
  MortarNormals<dim>                     normals;
  mortar::MultiplierNodes                multipliers;
  std::vector<std::vector<unsigned int>> row_nodes; ///< per row, ascending

  void              choose_multipliers(const PairGeometry<dim> &pair);
  mortar::FaceCover choose_functions(SlaveFace                           &face,
                                     const mortar::FaceIntegrals<double> &of_nodes,
                                     const mortar::CoverBox<dim>         &box,
                                     const Field                         &positions) const;
  mortar::CoverBox<dim>
  cover_box(const SlaveFace &face, const Points<double> &x, const Points<double> &n) const;
  std::vector<double> costs() const;
  void                set_shares();
  void                collect_row_nodes();
  void                leave_out_far_rows(const PairGeometry<dim> &pair);
  template <typename Number>
  std::vector<mortar::MortarFace<dim, Number>> masters(const SlaveFace      &face,
                                                       const Points<Number> &x) const;
  template <typename Number>
  mortar::FaceIntegrals<Number>
  integrals(const SlaveFace &face, const Points<Number> &x, const Points<Number> &n) const;
  template <typename Number>
  using UseIntegrals = std::function<void(unsigned int, const mortar::FaceIntegrals<Number> &)>;
  /// Compute the integrals of all slave faces at positions @p x and normals @p n. Call @p use with
  /// the place of a slave face in faces and its integrals, one face after the other, because the
  /// integrals of all faces take much memory. Collective.
  template <typename Number>
  void for_each_integrals(const Points<Number>       &x,
                          const Points<Number>       &n,
                          const UseIntegrals<Number> &use) const;
  /// Call visit(place in row_nodes[row], weight) for @p node, or for each of its masters if @p node
  /// hangs.
  template <typename Visit>
  void for_each_place(unsigned int row, unsigned int node, const Visit &visit) const
  {
    const auto at = [&](unsigned int wanted, double weight) {
      const auto &nodes = row_nodes[row];
      // The search always succeeds, because collect_row_nodes() has visited the same faces.
      visit(std::lower_bound(nodes.begin(), nodes.end(), wanted) - nodes.begin(), weight);
    };
    if (surface.masters(node).empty())
      at(node, 1.);
    for (const auto &master : surface.masters(node))
      at(master.first, master.second);
  }

  /// This struct holds what the parts of the sums depend on that are integrals over one slave face.
  template <typename Number>
  struct FacePart
  {
    const SlaveFace                     &face;
    const mortar::FaceIntegrals<Number> &integrals;
    const Points<Number>                &x;
    dealii::Tensor<1, dim>               origin = {}; ///< of the positions in the offsets
  };

  /// Call add(number, entry) for each number that one slave face contributes to the entries of
  /// @p sums, one RowSum per row.
  template <typename Number, typename Sums, typename Add>
  void for_each_part(const FacePart<Number> &part, Sums &sums, const Add &add) const;
  template <typename Number>
  std::vector<RowSum<Number>> row_sums(const Points<Number> &x, const Points<Number> &n) const;
  /// Return row @p i from its sum and the normals @p n of the slave side.
  template <typename Number>
  Row<dim, Number> row(unsigned int          i,
                       const RowSum<Number> &sum,
                       const Points<Number> &x,
                       const Points<Number> &n) const;
  /// Return the derivatives of the scalar of add_gradient() with respect to the sums of the rows.
  /// Add the derivatives with respect to positions and normals at fixed sums.
  std::vector<RowSum<double>> add_sum_derivatives(const Field                       &positions,
                                                  const Field                       &of_nodes,
                                                  const std::vector<RowSlopes<dim>> &of_rows,
                                                  Field                             &gradient,
                                                  Field &normal_gradient) const;
  /// Add the derivatives through the integrals from the @p slopes with respect to the sums.
  void add_sums_gradient(const std::vector<RowSum<double>>         &slopes,
                         const Field                               &positions,
                         const typename MortarNormals<dim>::Values &at_positions,
                         Field                                     &gradient) const;
  void add_face_gradient(const SlaveFace                   &face,
                         const std::vector<RowSum<double>> &slopes,
                         const Field                       &positions,
                         const Field                       &of_nodes,
                         Field                             &gradient,
                         Field                             &normal_gradient) const;
};
} // namespace snug::contact

#endif
