// SPDX-License-Identifier: MIT
// C++ exceptions in WebAssembly: the functions that the compiler calls for throw and catch.
// Debian's libc++abi for this target is built without them. They follow the Itanium C++ ABI,
// "Exception Handling", with WebAssembly's conventions:
//
// 1. `throw` is an instruction with a tag, whose operand is the address of the record of an
//    exception.
// 2. The engine unwinds the stack. Where a `catch` of the source may match, the code stores the
//    number of the landing pad and the address of its function's table. It calls
//    _Unwind_CallPersonality(), which answers with the index of the matching type, or with 0. The
//    code then goes on to the handler, or throws on.
//
// Types are compared by address, as all is linked into one module. Classes have one base at most,
// at their beginning, so that no address has to be adjusted.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <typeinfo>

namespace {

// On this target it returns its argument.
using Destructor = void* (*)(void*);

// What stands before the object of an exception.
struct alignas(16) Record {
  const std::type_info* type;
  Destructor destroy;
  int owners;            // a throw, and every exception_ptr
  int handlers;          // that are running
  bool is_thrown_again;  // by a handler, which has not ended yet
  Record* caught_before;
};

Record* record_of(void* object) {
  return static_cast<Record*>(object) - 1;
}

Record* caught = nullptr;
unsigned uncaught = 0;

void release(Record* record) {
  if (--record->owners > 0) return;
  if (record->destroy) record->destroy(record + 1);
  std::free(record);
}

[[noreturn]] void raise(Record* record) {
  ++uncaught;
  __builtin_wasm_throw(0, record);
}

// The type information of a class with one base, as the compiler writes it.
struct ClassWithBase {
  const void* table;
  const char* name;
  const std::type_info* base;
};

}  // namespace

// The table of functions that such type information begins with. Two words precede the functions.
extern "C" const void* const _ZTVN10__cxxabiv120__si_class_type_infoE[];

namespace {

// A handler of `wanted` catches exceptions of `type` and, with null, all.
bool matches(const std::type_info* wanted, const std::type_info* type) {
  while (wanted && wanted != type) {
    const auto* info = reinterpret_cast<const ClassWithBase*>(type);
    if (info->table != _ZTVN10__cxxabiv120__si_class_type_infoE + 2) return false;
    type = info->base;
  }
  return true;
}

// Reads the table of a function.
class Table {
 public:
  explicit Table(std::uintptr_t address) : at_(reinterpret_cast<const std::uint8_t*>(address)) {}

  std::uint8_t byte() { return *at_++; }
  std::uint32_t number() { return static_cast<std::uint32_t>(bits().value); }
  std::int32_t signed_number() {
    const auto [value, count, last] = bits();
    const bool negative = (last & 0x40) != 0 && count < 32;
    return static_cast<std::int32_t>(value | (negative ? ~std::uint64_t{0} << count : 0));
  }
  const std::uint8_t* here() const { return at_; }
  void move_to(const std::uint8_t* at) { at_ = at; }

 private:
  struct Bits {
    std::uint64_t value;
    unsigned count;
    std::uint8_t last;
  };
  // A number in base 128, the lowest digit first (LEB128).
  Bits bits() {
    Bits result{0, 0, 0x80};
    while (result.last & 0x80) {
      result.last = byte();
      result.value |= std::uint64_t{result.last & 0x7fu} << result.count;
      result.count += 7;
    }
    return result;
  }

  const std::uint8_t* at_;
};

constexpr std::uint8_t kOmitted = 0xff;

// Returns the index of the handler's type that catches `type` at a landing pad, or 0.
std::int32_t handler_of(const std::type_info* type, std::uintptr_t address, std::uint32_t pad) {
  Table table(address);
  if (table.byte() != kOmitted) table.number();  // the base of the landing pads
  if (table.byte() == kOmitted) return 0;        // no types
  const std::uint32_t size = table.number();
  const auto* types = reinterpret_cast<const std::type_info* const*>(table.here() + size);
  table.byte();  // how the call sites are encoded: base 128
  const std::uint32_t sites = table.number();
  const std::uint8_t* const actions = table.here() + sites;
  std::uint32_t action = 0;
  for (std::uint32_t n = 0; n <= pad; ++n) {
    table.number();
    action = table.number();
  }
  if (action == 0) return 0;
  // A chain: the index of a type, and how far the next link is.
  for (table.move_to(actions + action - 1);;) {
    const std::int32_t index = table.signed_number();
    const std::uint8_t* const link = table.here();
    const std::int32_t next = table.signed_number();
    if (index > 0 && matches(types[-index], type)) return index;
    if (next == 0) return 0;
    table.move_to(link + next);
  }
}

}  // namespace

extern "C" {

// The generated code has this name and these fields in it.
struct {
  std::uint32_t pad;
  std::uintptr_t table;
  std::int32_t selector;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* record) {
  __wasm_lpad_context.selector = handler_of(static_cast<Record*>(record)->type,
                                            __wasm_lpad_context.table, __wasm_lpad_context.pad);
  return 0;
}

void* __cxa_allocate_exception(std::size_t size) {
  void* const memory = std::calloc(1, sizeof(Record) + size);
  if (!memory) std::terminate();
  return static_cast<Record*>(memory) + 1;
}

void __cxa_free_exception(void* object) {
  std::free(record_of(object));
}

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, Destructor destroy) {
  Record* const record = record_of(object);
  record->type = type;
  record->destroy = destroy;
  record->owners = 1;
  raise(record);
}

void* __cxa_begin_catch(void* thrown) {
  auto* const record = static_cast<Record*>(thrown);
  --uncaught;
  // A handler that throws its exception again leaves it on the list until the handler's end.
  if (record->handlers++ == 0) {
    record->caught_before = caught;
    caught = record;
  }
  record->is_thrown_again = false;
  return record + 1;
}

void __cxa_end_catch() {
  Record* const record = caught;
  if (--record->handlers > 0) return;
  caught = record->caught_before;
  if (!record->is_thrown_again) release(record);
}

[[noreturn]] void __cxa_rethrow() {
  if (!caught) std::terminate();
  caught->is_thrown_again = true;
  raise(caught);
}

// For exception_ptr.
void* __cxa_current_primary_exception() noexcept {
  if (!caught) return nullptr;
  ++caught->owners;
  return caught + 1;
}

void __cxa_increment_exception_refcount(void* object) noexcept {
  if (object) ++record_of(object)->owners;
}

void __cxa_decrement_exception_refcount(void* object) noexcept {
  if (object) release(record_of(object));
}

void __cxa_rethrow_primary_exception(void* object) {
  if (!object) return;
  ++record_of(object)->owners;
  raise(record_of(object));
}

unsigned __cxa_uncaught_exceptions() noexcept {
  return uncaught;
}
bool __cxa_uncaught_exception() noexcept {
  return uncaught > 0;
}

}  // extern "C"

// The library's own returns null if there is no memory.
void* operator new(std::size_t size) {
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}
void* operator new[](std::size_t size) {
  return operator new(size);
}
