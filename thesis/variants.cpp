#include "thesis/variants.hpp"

#include <array>
#include <vector>

#include "thesis/plu.hpp"
#include "thesis/sat.hpp"
#include "thesis/slabs_forms.hpp"
#include "thesis/woo.hpp"

#ifdef __FAST_MATH__
#error "axis-parallel rays have infinite and NaN distances: build without -ffast-math"
#endif

namespace hitpipe::thesis {
namespace {

template <class T>
BasicAabb<T> converted(const Aabb& box) {
  return {glm::vec<3, T>(box.min), glm::vec<3, T>(box.max)};
}

template <class Test, class T>
class Prepared final : public PreparedBoxTests {
 public:
  explicit Prepared(std::span<const BoxPair> pairs) {
    rays_.reserve(pairs.size());
    boxes_.reserve(pairs.size());
    for (const BoxPair& pair : pairs) {
      rays_.emplace_back(pair.ray);
      boxes_.push_back(converted<T>(pair.box));
    }
  }

  [[nodiscard]] Sum run() const override {
    Sum sum;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      T entry = 0;
      if (!Test::test(rays_[i], boxes_[i], entry)) continue;
      ++sum.hits;
      if constexpr (Test::has_distance) sum.entries += static_cast<double>(entry);
    }
    return sum;
  }

 private:
  std::vector<typename Test::Ray> rays_;
  std::vector<BasicAabb<T>> boxes_;
};

template <class Test, class T>
BoxAnswer ask(const Ray& ray, const Aabb& box) {
  T entry = 0;
  const bool hit = Test::test(typename Test::Ray(ray), converted<T>(box), entry);
  return {hit, hit ? static_cast<double>(entry) : 0};
}

template <class Test, class T>
std::unique_ptr<PreparedBoxTests> prepare(std::span<const BoxPair> pairs) {
  return std::make_unique<Prepared<Test, T>>(pairs);
}

template <class Test, class T>
constexpr BoxTestVariant variant(std::string_view name) {
  return {name, Test::has_distance, ask<Test, T>, prepare<Test, T>};
}

template <class T>
constexpr std::array variants{variant<Plu<T, Distance::none>, T>("plu"),
                              variant<Plu<T, Distance::divide>, T>("plu-int-div"),
                              variant<Plu<T, Distance::multiply>, T>("plu-int-mul"),
                              variant<PluCff<T, Distance::none>, T>("plu-cff"),
                              variant<PluCff<T, Distance::divide>, T>("plu-cff-int-div"),
                              variant<PluCff<T, Distance::multiply>, T>("plu-cff-int-mul"),
                              variant<SlabsForm<T, Distance::divide>, T>("slabs-div"),
                              variant<SlabsForm<T, Distance::multiply>, T>("slabs-mul"),
                              variant<Slabs8<T, Distance::divide>, T>("slabs8-div"),
                              variant<Slabs8<T, Distance::multiply>, T>("slabs8-mul"),
                              variant<Sat<T>, T>("sat"),
                              variant<Woo<T>, T>("woo")};

}  // namespace

template <>
std::span<const BoxTestVariant> box_test_variants<float>() {
  return variants<float>;
}
template <>
std::span<const BoxTestVariant> box_test_variants<double>() {
  return variants<double>;
}

}  // namespace hitpipe::thesis
