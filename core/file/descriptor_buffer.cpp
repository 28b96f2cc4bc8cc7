#include "core/file/descriptor_buffer.hpp"

#include "core/file/descriptor.hpp"

namespace nextview {

DescriptorBuffer::DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
  setp(held_.data(), held_.data() + held_.size());
}

int DescriptorBuffer::flush() {
  if (error_ == 0) error_ = write_all(descriptor_, {pbase(), static_cast<std::size_t>(pptr() - pbase())});
  setp(held_.data(), held_.data() + held_.size());
  return error_;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type byte) {
  if (flush() != 0) return traits_type::eof();
  if (!traits_type::eq_int_type(byte, traits_type::eof())) sputc(traits_type::to_char_type(byte));
  return traits_type::not_eof(byte);
}

}  // namespace nextview
