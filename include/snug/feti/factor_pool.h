#ifndef snug_feti_factor_pool_h
#define snug_feti_factor_pool_h

#include <snug/feti/sparse_factor.h>

#include <memory>
#include <vector>

namespace snug::feti {
/**
 * Matrices of one pattern with their symbolic factorizations, by CHOLMOD
 * if PETSc's options name no other package: these matrices are small,
 * whatever the package of the stiffness. Faces come and go with the active set and several may live
 * at a time; what one leaves behind serves the next.
 */
class FactorPool
{
public:
  struct Item
  {
    Item(const CsrMatrix &pattern, const FactorOf of)
      : matrix(pattern), factor(matrix, of, Factorization::CHOLMOD)
    {}

    CsrMatrix    matrix; ///< fill in values, then factor.factorize()
    SparseFactor factor;
  };

  explicit FactorPool(const FactorOf the_use) : of(the_use) {}

  /// An item with the values of @p matrix, whose pattern is that of all
  /// others. It returns when the pointer and its copies are gone, which
  /// may be after the end of the pool.
  std::shared_ptr<Item> take(const CsrMatrix &matrix) const;

private:
  using Items = std::vector<std::unique_ptr<Item>>;

  FactorOf               of;
  std::shared_ptr<Items> spare = std::make_shared<Items>();
};
} // namespace snug::feti

#endif
